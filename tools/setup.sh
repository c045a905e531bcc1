#!/usr/bin/env bash
# Installs what crestline needs to be built, run and tested, R included. Looks first: when nothing is
# missing it ends in about a second.
# With CRESTLINE_NEEDS=demo only what `make demo` needs.
#   Debian or Ubuntu, as root or with sudo: built packages by apt, the rest from CRAN
#   elsewhere: R and a compiler must be there; packages come from CRAN into a library that can be written
set -euo pipefail
cd "$(dirname "$0")/.."
. tools/steps.sh

DEBIAN_PACKAGES="r-base-core r-base-dev ca-certificates"
[ "${CRESTLINE_NEEDS:-all}" = demo ] || DEBIAN_PACKAGES="$DEBIAN_PACKAGES pandoc qpdf"
APT_OPTIONS="-y --no-install-recommends -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3"

as_root=no
if [ "$(id -u)" -eq 0 ]; then as_root=; elif sudo -n true 2>/dev/null; then as_root="sudo -n"; fi
has_apt=no
if command -v apt-get >/dev/null && [ "$as_root" != no ]; then has_apt=yes; fi

apt_update() {
  [ -z "${apt_is_fresh:-}" ] || return 0
  step "apt-get update" $as_root apt-get update
  apt_is_fresh=yes
}

apt_install() {
  apt_update
  step "apt-get install, $# asked for: $*" $as_root env DEBIAN_FRONTEND=noninteractive apt-get install $APT_OPTIONS "$@"
}

is_installed() { [ "$(dpkg-query -W -f '${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# An R that is not Debian's own, as on a CI service, does not see Debian's built packages.
if command -v Rscript >/dev/null && ! is_installed r-base-core; then has_apt=no; fi

install_r() {
  local lacking=()
  for package in $DEBIAN_PACKAGES; do is_installed "$package" || lacking+=("$package"); done
  [ ${#lacking[@]} -eq 0 ] || apt_install "${lacking[@]}"
}

require_r() {
  command -v Rscript >/dev/null || die "R is not here and this is not a Debian machine with root: install R (>= 4.2) first"
  command -v "$(R CMD config CXX17 | cut -d ' ' -f 1)" >/dev/null || die "no C++17 compiler: install one first"
  command -v pandoc >/dev/null || say "    note: pandoc is not here; HTML pages and vignettes need it"
}

# Of the packages that are missing and what they need in turn, those that Debian has built.
debian_builds() {
  local wanted
  wanted=$(Rscript tools/packages.R closure) || die "the list of CRAN packages could not be read"
  comm -12 <(tr '[:upper:]' '[:lower:]' <<<"$wanted" | sed 's/^/r-cran-/' | sort) \
           <(apt-cache pkgnames r-cran- | sort)
}

install_from_debian() {
  apt_update
  local built package
  built=()
  while read -r package; do built+=("$package"); done < <(debian_builds)
  [ ${#built[@]} -eq 0 ] || apt_install "${built[@]}"
}

# No debugging symbols: they double the time Rvcg takes to compile.
install_from_cran() {
  local flags
  flags=$(mktemp)
  printf '%s = -g0 -O2\n' CFLAGS CXXFLAGS CXX11FLAGS CXX14FLAGS CXX17FLAGS > "$flags"
  case " $* " in *" Rvcg "*) say "    Rvcg has to be compiled: about 5 minutes on two free cores" ;; esac
  case " $* " in *" Morpho "*) say "    Morpho has to be compiled: about 2 minutes" ;; esac
  step "from CRAN, on $(cores) cores: $*" \
    env -u MAKELEVEL -u MFLAGS MAKEFLAGS="-j$(cores)" R_MAKEVARS_USER="$flags" Rscript tools/packages.R install
  rm -f "$flags"
}

begun=$SECONDS
say "==> set-up: what is missing"
if [ "$has_apt" = yes ]; then install_r; else require_r; fi
missing=$(Rscript tools/packages.R missing)
if [ -n "$missing" ] && [ "$has_apt" = yes ]; then
  install_from_debian
  missing=$(Rscript tools/packages.R missing)
fi
if [ -n "$missing" ]; then
  install_from_cran $missing
  missing=$(Rscript tools/packages.R missing)
  [ -z "$missing" ] || say "    note: suggested, but not offered for this R: $missing"
fi
say "    ready: $(Rscript -e 'cat(R.version.string)'), $((SECONDS - begun)) s"

# Sourced by the other scripts: one line a step with its seconds, a sign of life on long ones.

HEARTBEAT_SECONDS=${HEARTBEAT_SECONDS:-20}

say() { printf '%s\n' "$*"; }

die() { printf 'crestline: %s\n' "$*" >&2; exit 1; }

cores() { nproc 2>/dev/null || getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1; }

# "12 of 37 files": how far the package is that was begun last in a log; R unpacks it into a folder for temporary files.
files_of() {
  local package compiled total
  package=$(sed -nE 's/^\* installing \*source\* package [^A-Za-z]*([A-Za-z0-9.]+).*/\1/p' "$1" | tail -n 1)
  compiled=$(awk '/installing \*source\* package/ { n = 0 } / -c / { n++ } END { print n + 0 }' "$1")
  total=0
  [ -z "$package" ] || total=$(find "${TMPDIR:-/tmp}"/R.INSTALL*/"$package"/src \( -name '*.c' -o -name '*.cc' -o -name '*.cpp' -o -name '*.f' -o -name '*.f90' \) 2>/dev/null | wc -l)
  if [ "$total" -ge "$compiled" ]; then echo "$compiled of $((total)) files"; else echo "$compiled files so far"; fi
}

# Where a command has got to, from its log: the file it compiles, or the last line that is not a compiler's remark.
sign_of_life() {
  local line
  line=$(tr '\r' '\n' < "$1" | grep -E '^(g\+\+|gcc|\*|[A-Z]| {2,4}[^ ])' |
    grep -vE '^ *[0-9]* *\||^In |:[0-9]+:|^ .*(warning|note|required)' | tail -n 1)
  case $line in
    *" -c "*) echo "compiling $(sed -E 's/.* -c ([^ ]+).*/\1/' <<<"$line"), $(files_of "$1")" ;;
    *) cut -c 1-90 <<<"$line" ;;
  esac
}

heartbeat() {
  local log=$1 begun=$SECONDS
  while sleep "$HEARTBEAT_SECONDS" </dev/null >/dev/null 2>&1; do
    printf '      %4d s  %s\n' $((SECONDS - begun)) "$(sign_of_life "$log")"
  done
}

# step WHAT COMMAND...: runs the command with its output in a log; the log is shown if it fails.
step() {
  local what=$1 log begun=$SECONDS beat status=0
  shift
  log=$(mktemp "${TMPDIR:-/tmp}/crestline-step-XXXXXX")
  printf '==> %s\n' "$(cut -c 1-110 <<<"$what")"
  heartbeat "$log" & beat=$!
  "$@" >"$log" 2>&1 </dev/null || status=$?
  kill "$beat" 2>/dev/null; wait "$beat" 2>/dev/null || true
  if [ "$status" -eq 0 ]; then
    printf '    done in %d s\n' $((SECONDS - begun))
  else
    tail -n 60 "$log" | sed 's/^/    | /'
    printf '    FAILED after %d s (exit %d): %s\n' $((SECONDS - begun)) "$status" "$what"
  fi
  rm -f "$log"
  return "$status"
}

# copy_tree TARGET: the project's files as git sees them (what it ignores stays out), to build away from the tree.
# Without git's record of them (an unpacked archive): everything but hidden folders and demo-output.
copy_tree() {
  if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
    git ls-files --cached --others --exclude-standard -z |
      while IFS= read -r -d '' file; do [ ! -e "$file" ] || printf '%s\0' "$file"; done |
      tar --create --null --files-from=- | tar --extract --directory="$1"
  else
    tar --create --exclude=./.git --exclude=./.cache --exclude=./demo-output --exclude='*.o' --exclude='*.so' . |
      tar --extract --directory="$1"
  fi
}

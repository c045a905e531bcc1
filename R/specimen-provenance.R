# Where a value came from, as a list that it carries and as lines of text.

#' Package and R that something was made with
#' @noRd
made_with <- function() {
  list(package = as.character(utils::packageVersion("crestline")),
       r = paste(R.version$major, R.version$minor, sep = "."))
}

#' @noRd
specimen_provenance <- function(specimen) {
  c(made_with(), list(mesh = mesh_provenance(specimen), landmarks = origin_of(specimen)))
}

mesh_provenance <- function(specimen) {
  rescaled <- specimen$report$action[specimen$report$check == "rescaled vertices"]
  c(list(id = specimen$id, key = specimen_key(specimen),
         file = c(specimen$file, NA_character_)[1]),
    if (length(rescaled)) list(rescaled = rescaled))
}

#' Provenance in lines of text
#'
#' @param x A provenance: list of `package`, `r`, and those known of `scheme` (`name`, `hash`,
#'   `unit`), `mesh` (`id`, `key`, `file`), `landmarks` (as of [new_origin()]), `specimens` (data
#'   frame `id`, `file`, `key`, `landmarks`), `template` (`id`, `hash`), `settings` (list of lists
#'   of arguments).
#' @return Text without line breaks, a line for each part, with its name first.
#' @noRd
provenance_lines <- function(x) {
  if (!length(x)) return("not recorded: made by an older version")
  lines <- c(
    if (!is.null(x$package)) sprintf("made with: crestline %s, R %s", x$package, x$r),
    scheme_line(x$scheme), if (!is.null(x$mesh)) mesh_line(x$mesh),
    if (!is.null(x$landmarks)) paste("landmarks:", origin_words(x$landmarks)),
    specimens_lines(x$specimens),
    if (!is.null(x$template)) sprintf("template: %s, hash %s", x$template$id, x$template$hash),
    settings_lines(x$settings)
  )
  gsub("[[:cntrl:]]+", " ", lines)
}

scheme_line <- function(scheme) {
  if (is.null(scheme)) return(NULL)
  text <- sprintf("scheme: %s, hash %s", scheme$name, scheme$hash)
  if (is.null(scheme$unit) || scheme$unit == 1) return(text)
  sprintf("%s, its lengths divided by %g", text, scheme$unit)
}

mesh_line <- function(mesh) {
  if (is.null(mesh$file)) return(paste("mesh: key", mesh$key))
  from <- if (is.na(mesh$file)) "not from a file" else paste("from", basename(mesh$file))
  paste(c(sprintf("mesh: key %s, %s", mesh$key, from), mesh$rescaled), collapse = ", ")
}

specimens_lines <- function(specimens, most = 3) {
  if (!NROW(specimens)) return(NULL)
  files <- basename(specimens$file[!is.na(specimens$file)])
  from <- if (length(files)) sprintf("%d from files (%s)", length(files), shorten(files, most))
  ways <- sort(table(specimens$landmarks), decreasing = TRUE)
  told <- names(utils::head(ways, most))
  each <- vapply(told, function(way) {
    own <- specimens$id[specimens$landmarks == way]
    who <- if (length(own) > 4) amount(length(own), "specimen") else paste(own, collapse = ", ")
    sprintf("%s of %s", way, who)
  }, "")
  more <- if (length(ways) > most) amount(sum(ways) - sum(ways[told]), "more specimen")
  c(sprintf("meshes: %s, %s", amount(length(unique(specimens$key)), "mesh", "meshes"),
            if (is.null(from)) "not from files" else from),
    paste("landmarks:", paste(c(each, more), collapse = "; ")))
}

settings_lines <- function(settings) {
  settings <- Filter(length, settings)
  if (!length(settings)) return(NULL)
  each <- vapply(names(settings), function(stage) {
    paste(stage, changed_words(settings[[stage]], default_settings(stage)))
  }, "")
  paste("settings:", paste(each, collapse = "; "))
}

#' Defaults of what is set in a stage
#' @noRd
default_settings <- function(name) {
  of <- function(f, ...) {
    f <- match.fun(f)
    lapply(as.list(formals(f))[c(...)], eval, envir = environment(f))
  }
  switch(name, ridge = unclass(match.fun("ridge_settings")()),
         slide = unclass(match.fun("slide_settings")()),
         fit = c(unclass(match.fun("shape_settings")()), list(given = character())),
         homologise = of("homologise", "tolerance", "rounds"),
         align = c(of("align", "scale", "tangent"), of("align_settings", "tolerance", "rounds"),
                   list(missing = "estimate")),
         pca = of("shape_pca", "tolerance"),
         compare = c(of("compare_groups", "n_perm", "equal_spread"),
                     of("comparison_settings", "components", "tests", "n_boot"),
                     list(exchange = "free")),
         list())
}

#' Settings that are not as by default
#' @noRd
changed_words <- function(values, defaults) {
  same <- vapply(names(values), function(name) {
    isTRUE(all.equal(values[[name]], defaults[[name]], check.attributes = FALSE))
  }, NA)
  if (all(same)) return("as by default")
  changed <- values[!same]
  paste(names(changed), "=", vapply(changed, setting_word, ""), collapse = ", ")
}

setting_word <- function(value, most = 4) {
  if (is.null(value)) return("NULL")
  if (!is.atomic(value)) return(class(value)[1])
  if (length(value) > most) return(amount(length(value), "value"))
  paste(if (is.numeric(value)) signif(value, 6) else value, collapse = ", ")
}

#' The same as a part of a page that opens on a click
#' @noRd
provenance_block <- function(provenance) {
  tags <- htmltools::tags
  tags$details(class = "provenance", tags$summary("Where this came from"),
               tags$pre(style = "white-space:pre-wrap",
                        paste(provenance_lines(provenance), collapse = "\n")))
}

#' What is known of anything that is written to a file; NULL of bare meshes and matrices
#' @noRd
#' @exportS3Method
provenance_of.specimen <- function(x) specimen_provenance(x)

#' Lines of a provenance as plain ASCII, for comments in files
#' @noRd
provenance_comments <- function(provenance) {
  if (length(provenance)) comment_text(provenance_lines(provenance))
}

#' A summary: what print() says, and where it came from
#'
#' @param lines Text.
#' @noRd
new_summary <- function(lines, provenance, ...) {
  structure(list(lines = lines, provenance = provenance, ...), class = "crestline_summary")
}

#' @export
print.crestline_summary <- function(x, ...) {
  printed(x, {
    cat(x$lines, sep = "\n")
    print_provenance(x$provenance)
    invisible(x)
  })
}

print_provenance <- function(provenance, width = 80) {
  cat("provenance\n")
  for (line in provenance_lines(provenance)) {
    cat(strwrap(line, width, indent = 2, exdent = 4), sep = "\n")
  }
}

printed_lines <- function(x, ...) utils::capture.output(print(x, ...))

#' Summaries, with provenance
#'
#' A summary has the lines of `print()`, and the provenance of the object:
#'
#' * the versions of the package and of R;
#' * the scheme, with the hash of its tables;
#' * the key and file of the mesh;
#' * the origin of each landmark: a file, given, found, predicted, placed or moved by hand (and the
#'   time), moved by its definition;
#' * the template against which points were slid;
#' * the settings that are not the default.
#'
#' Shapes, samples and results have it as the field `provenance`. Files that the package writes
#' include it if their format has a place for comments, see [write_mesh()] and [write_landmarks()].
#'
#' @param object A [specimen()], a `curve`, a `shape`, a `shape_sample`, an `aligned`, a `shape_pca`
#'   or a `repeatability`.
#' @param ... Ignored.
#' @return Object of class `crestline_summary`, a list:
#'   * `lines`: the text (character);
#'   * `provenance`: a list of `package` and `r` (versions). If the object has them, it also has
#'     `scheme` (`name`, `hash`, `unit`), `mesh` (`id`, `key`, `file`), `template` (`id`, `hash`)
#'     and `settings`. Two data frames are `landmarks` (`landmark`, `how`, `file`, `time`) and
#'     `specimens` (`id`, `file`, `key`, `landmarks`).
#'
#'   For a `shape_pca`: the summary of `prcomp`, with a field `provenance`.
#' @template glossary
#' @seealso [summary.group_comparison()]
#' @examples
#' ball <- specimen(Rvcg::vcgSphere(3), rbind(top = c(0, 0, 1), front = c(1, 0, 0)), id = "ball")
#' ball$landmarks["top", ] <- c(0, 0.6, 0.8)
#' summary(ball)
#' summary(ball)$provenance$landmarks
#' @name provenance
#' @aliases summary.specimen
#' @export
summary.specimen <- function(object, ...) {
  new_summary(printed_lines(object), specimen_provenance(object))
}

#' @exportS3Method
comment_lines.specimen <- function(x) provenance_comments(provenance_of(x))

#' @exportS3Method
written_landmarks.specimen <- function(x) {
  x <- check_class(x, "specimen", "x", "specimen() or read_specimen()")
  inform_predicted(x)
  list(landmarks = x$landmarks, curves = if (is.null(x$drawn)) attr(x, "curves") else x$drawn)
}

# How each landmark of a specimen came to its place, and its mesh from which file.

#' The time by the clock of the world
#' @noRd
time_stamp <- function(time = Sys.time()) format(time, "%Y-%m-%dT%H:%M:%SZ", tz = "UTC")

#' The record of a specimen's landmarks as they are now; what is not recorded was given
#' @noRd
origin_of <- function(specimen) {
  now <- new_origin(specimen$landmarks, "given")
  before <- specimen$origin
  row <- match(now$landmark, before$landmark)
  known <- which(!is.na(row) & !is.na(now$how))
  known <- known[!is.na(before$how[row[known]])]
  now[known, ] <- before[row[known], names(now)]
  now
}

#' A specimen with the record of some landmarks changed
#' @noRd
with_origin <- function(specimen, landmarks, how, file = NA_character_, time = NA_character_) {
  origin <- origin_of(specimen)
  at <- match(landmarks, origin$landmark)
  some <- specimen$landmarks[at, , drop = FALSE]
  origin[at, ] <- new_origin(some, how, file, time)
  with_fields(specimen, origin = origin)
}

#' The record after landmarks were set by the user: those at another place were moved or placed by
#' hand
#'
#' @param specimen As it was before.
#' @param landmarks What they are set to.
#' @noRd
origin_after <- function(specimen, landmarks) {
  given <- nrow(specimen$landmarks) == 0
  known <- origin_of(specimen)
  origin <- new_origin(landmarks, if (given) "given" else "placed",
                       time = if (given) NA_character_ else time_stamp())
  row <- match(origin$landmark, known$landmark)
  before <- specimen$landmarks[row, , drop = FALSE]
  there <- !is.na(before[, 1]) & !is.na(landmarks[, 1])
  same <- there & rowSums(before != landmarks) == 0
  origin$how[there & !same] <- "moved"
  origin[which(same), ] <- known[row[which(same)], ]
  origin
}

#' A specimen that was read from files
#'
#' @param file Path of its mesh.
#' @param landmarks Path of its landmarks, NA where these were given.
#' @noRd
from_files <- function(specimen, file, landmarks = NA_character_) {
  specimen <- with_fields(specimen, file = file)
  if (is.na(landmarks)) return(specimen)
  with_origin(specimen, rownames(specimen$landmarks), "file", landmarks)
}

#' The record of landmarks in words: how many came in which way, which of them by hand and when
#' @noRd
origin_words <- function(origin) {
  if (is.null(origin)) return("not recorded")
  origin <- origin[!is.na(origin$how), ]
  if (!nrow(origin)) return("none")
  words <- c(file = "from a file", given = "given", found = "found", predicted = "predicted",
             placed = "placed by hand",
             moved = "moved by hand", defined = "moved by definition")
  each <- lapply(intersect(names(words), origin$how), function(how) {
    own <- origin[origin$how == how, ]
    named <- how %in% c("placed", "moved", "defined")
    files <- unique(basename(own$file[!is.na(own$file)]))
    times <- sort(unique(own$time[!is.na(own$time)]))
    details <- c(if (length(files)) shorten(files, 3), if (named) shorten(own$landmark, 6),
                 if (length(times) > 1) paste(times[1], "to", times[length(times)]) else times)
    paste0(nrow(own), " ", words[[how]],
           if (length(details)) sprintf(" (%s)", paste(details, collapse = "; ")))
  })
  paste(unlist(each), collapse = ", ")
}

#' Say which written landmarks read_specimen() would refuse: predicted ones that lie off the scan
#' @param tolerance As in [specimen()].
#' @noRd
inform_predicted <- function(x, tolerance = 0.01) {
  predicted <- intersect(x$placing$landmark[x$placing$state == "predicted"], rownames(x$landmarks))
  at <- x$landmarks[predicted, , drop = FALSE]
  at <- at[stats::complete.cases(at), , drop = FALSE]
  if (!nrow(at)) return(invisible())
  away <- row_lengths(as.matrix(surface_points(x$mesh, at)[c("x", "y", "z")]) - at)
  off <- rownames(at)[away > tolerance * specimen_size(x)]
  if (!length(off)) return(invisible())
  crestline_inform(c(
    sprintf("specimen %s: predicted landmarks lie off the scan: %s.", x$id, shorten(off)),
    i = "With this file read_specimen() refuses them. saveRDS() keeps the specimen as it is."
  ))
}

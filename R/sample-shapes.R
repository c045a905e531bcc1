# A batch of shapes as a list: some in memory, some in files, some that failed.

#' A batch from its parts
#'
#' @param shapes Named list: a `shape` or `kept_shape` each, NULL where it failed.
#' @param failed Named list of `shape_failure`s, for those that are NULL.
#' @param scheme List: `name`, `key` (hash) of the scheme that all were measured by; NULL where it
#'   is not known.
#' @param read Ids of those whose results were in the folder already.
#' @noRd
new_shape_batch <- function(shapes, failed = list(), scheme = NULL, read = character()) {
  structure(shapes, failed = failed, scheme = scheme, read = read, class = "shape_batch")
}

validate_shape_batch <- function(x) {
  fail <- function(problem, remedy) crestline_abort(problem, remedy, stage = "batch")
  elements <- unclass(x)
  ids <- names(elements)
  if (is.null(ids) && length(elements) || anyNA(ids) || any(!nzchar(ids))) {
    fail("a specimen of the batch has no id.", "Name the elements by the ids of their specimens.")
  }
  if (anyDuplicated(ids)) {
    fail(sprintf("the specimen %s is in the batch twice.", shorten(unique(ids[duplicated(ids)]))),
         "Leave out one of the two, or measure it with another id.")
  }
  none <- vapply(elements, is.null, NA)
  wrong <- ids[!none & !vapply(elements, inherits, NA, "shape")]
  if (length(wrong)) {
    fail(sprintf("%s of the batch is no shape.", shorten(wrong)),
         "Put only shapes into it, as of fit_shape().")
  }
  if (!all(ids[none] %in% names(attr(x, "failed")))) {
    fail(sprintf("nothing tells why %s is not there.",
                 shorten(setdiff(ids[none], names(attr(x, "failed"))))),
         "Leave specimens out with x[-i] or x[ids], not by assigning NULL to them.")
  }
  x
}

#' A batch of results: shapes, and failures by themselves
#' @noRd
batch_of <- function(results, scheme, read = character()) {
  failed <- vapply(results, inherits, NA, "shape_failure")
  shapes <- results
  shapes[failed] <- list(NULL)
  about <- list(name = scheme$name, key = content_hash(unclass(scheme)))
  validate_shape_batch(new_shape_batch(shapes, results[failed], about, read))
}

#' A batch as former versions made it: results in files are an attribute there, failures stand among
#' the shapes
#' @noRd
renewed_batch <- function(x) {
  files <- attr(x, "files")
  if (is.null(files)) return(x)
  results <- unclass(x)
  attributes(results) <- list(names = names(results))
  kept <- !vapply(files, is.null, NA)
  results[kept] <- Map(function(file, id) {
    kept_shape(list(key = NA_character_, file = file, name = id), NULL)
  }, files[kept], names(results)[kept])
  failed <- vapply(results, inherits, NA, "shape_failure")
  shapes <- results
  shapes[failed] <- list(NULL)
  complete <- function(one) utils::modifyList(new_failure("", "", ""), one)
  new_shape_batch(shapes, lapply(results[failed], complete))
}

#' A shape that is in a file, and is read when one of its fields is asked for
#'
#' @param task List: `file`, `key` that it must have, `name` (id).
#' @param about Of the file: `warnings`, and what [told_of()] gives.
#' @param seen Size and time of the file when it was whole, as the index has them; NULL where it was
#'   not looked at.
#' @noRd
kept_shape <- function(task, about, seen = NULL) {
  kept <- list()
  attributes(kept) <- c(list(file = task$file, key = task$key, id = task$name,
                             warnings = if (NROW(about$warnings)) as.data.frame(about$warnings),
                             seen = seen), as_told(about), list(class = c("kept_shape", "shape")))
  kept
}

#' Which kept shapes have files that were not touched since they were whole
#' @param kept List of `kept_shape`s.
#' @noRd
untouched <- function(kept) {
  if (!length(kept)) return(logical())
  info <- file.info(vapply(kept, attr, "", "file"), extra_cols = FALSE)
  seen <- vapply(kept, function(one) paste(c("", attr(one, "seen")), collapse = " "), "")
  unname(!is.na(info$size) & seen == paste("", size_text(info), time_text(info)))
}

#' What keeps a shape from being read from its file: a failure, or NULL
#' @noRd
kept_fault <- function(x, opened = open_kept(attr(x, "file"))) {
  file <- attr(x, "file")
  if (opened$state == "whole" && identical(opened$about$key, attr(x, "key"))) return(NULL)
  own <- identical(opened$about$id, attr(x, "id")) &&
    identical(opened$about$surface, attr(x, "surface"))
  problem <- switch(opened$state, absent = "its file %s is not there.",
                    damaged = "its file %s is damaged or cut short.",
                    former = "its file %s is of a former version, which has no checksum.",
                    whole = if (own) "its file %s has a result of other landmarks or settings now."
                    else "its file %s has another result now.")
  remedy <- if (opened$state == "whole") {
    paste("Measure it again by fit_shapes(), or read what is there:", read_remedy(file))
  } else if (opened$state == "absent") {
    paste("If the folder was moved, read it where it is:",
          read_remedy(file, "path of the folder"), "Else run fit_shapes() again.")
  } else "Run fit_shapes() again: it is measured again."
  new_failure("keeping", sprintf(problem, file), remedy, kept_warnings(x))
}

read_remedy <- function(file, dir = dirname(file)) sprintf("read_batch(\"%s\").", dir)

#' A kept shape as a shape; the last one that was read is in memory still
#' @return The `shape`, or a `shape_failure`.
#' @noRd
read_shape <- function(x) {
  about <- file.info(attr(x, "file"), extra_cols = FALSE)
  now <- list(attr(x, "file"), attr(x, "key"), attr(x, "id"), about$size, about$mtime)
  if (!is.na(about$size) && identical(now, last_read$what)) return(last_read$shape)
  opened <- open_kept(attr(x, "file"))
  fault <- kept_fault(x, opened)
  if (!is.null(fault)) return(fault)
  shape <- tryCatch(shape_in_file(opened, attr(x, "file")), crestline_keeping_error = function(e) {
    new_failure("keeping", e$problem, e$remedy, kept_warnings(x))
  })
  if (!inherits(shape, "shape")) return(shape)
  if (!identical(shape$id, attr(x, "id"))) shape <- renamed_shape(shape, attr(x, "id"))
  last_read$what <- now
  last_read$shape <- shape
  shape
}

last_read <- new.env(parent = emptyenv())

kept_warnings <- function(x) {
  warned <- attr(x, "warnings")
  if (is.null(warned)) no_warnings() else warned
}

#' The shape in a file that was opened; one of the former layout is written anew in today's
#' @noRd
shape_in_file <- function(opened, file) {
  value <- kept_value(opened)
  if (inherits(value, "stored_shape")) return(from_stored(value, dirname(file)))
  if (inherits(value, "shape")) renew_file(value, opened$about, file)
  value
}

#' A shape whose mesh had another name when it was measured
#' @noRd
renamed_shape <- function(shape, id) {
  shape$id <- id
  if (inherits(shape$specimen, "specimen")) shape$specimen <- with_fields(shape$specimen, id = id)
  shape
}

#' A kept shape as a shape, or an error
#' @noRd
unkept <- function(x) {
  shape <- read_shape(x)
  if (inherits(shape, "shape")) return(shape)
  crestline_abort(shape$message, shape$remedy, shape$stage, attr(x, "id"),
                  class = "crestline_keeping_error", call = NULL)
}

#' @export
`$.kept_shape` <- function(x, name) unkept(x)[[name]]

#' @export
`[[.kept_shape` <- function(x, i, ...) unkept(x)[[i, ...]]

#' @export
`[.kept_shape` <- function(x, ...) unclass(unkept(x))[...]

#' @export
`$<-.kept_shape` <- function(x, name, value) {
  x <- unkept(x)
  x[[name]] <- value
  x
}

#' @export
`[[<-.kept_shape` <- function(x, i, value) {
  x <- unkept(x)
  x[[i]] <- value
  x
}

#' @export
names.kept_shape <- function(x) names(unkept(x))

#' @export
print.kept_shape <- function(x, ...) {
  printed(x, {
    print(unkept(x), ...)
    invisible(x)
  })
}

#' The place of one specimen, by id or number, or an error with near ids
#' @noRd
batch_place <- function(x, i) {
  ids <- names(x)
  one <- length(i) == 1 && !is.na(i)
  if (one && is.character(i) && i %in% ids) return(match(i, ids))
  if (one && is.numeric(i) && i %in% seq_along(ids)) return(as.integer(i))
  refuse_place(i, ids)
}

refuse_place <- function(i, ids) {
  words <- is.character(i) && length(i) && !all(i %in% ids)
  wrong <- if (words) shorten(paste0("\"", setdiff(i, ids), "\"")) else describe_value(i)
  near <- if (words && length(ids)) {
    sprintf("Near ids: %s.",
            shorten(ids[order(utils::adist(setdiff(i, ids)[1], ids, ignore.case = TRUE))]))
  } else sprintf("It has %s: names(x).", amount(length(ids), "specimen"))
  crestline_abort(sprintf("the batch has no specimen %s.", wrong), near, stage = "batch")
}

#' @export
`[[.shape_batch` <- function(x, i, ...) {
  x <- renewed_batch(x)
  i <- batch_place(x, i)
  shape <- unclass(x)[[i]]
  if (!inherits(shape, "kept_shape")) return(shape)
  shape <- read_shape(shape)
  if (inherits(shape, "shape")) return(shape)
  crestline_warn(shape$message, shape$remedy, shape$stage, names(x)[i],
                 class = "crestline_keeping_warning")
  NULL
}

#' @export
`$.shape_batch` <- function(x, name) x[[name]]

#' @export
`[.shape_batch` <- function(x, i, ...) {
  x <- renewed_batch(x)
  if (missing(i)) return(x)
  ids <- names(x)
  if (is.factor(i)) i <- as.character(i)
  index <- is.character(i) || is.numeric(i) || is.logical(i)
  if (!index || anyNA(i)) refuse_place(i, ids)
  at <- suppressWarnings(stats::setNames(seq_along(ids), ids)[i])
  if (anyNA(at)) {
    refuse_place(if (is.numeric(i)) i[i > length(ids)] else i, ids)
  }
  shapes <- unclass(x)[at]
  validate_shape_batch(new_shape_batch(
    shapes, attr(x, "failed")[intersect(names(shapes), names(attr(x, "failed")))],
    attr(x, "scheme"), intersect(attr(x, "read"), names(shapes))
  ))
}

#' @export
c.shape_batch <- function(...) {
  given <- list(...)
  for (one in given) check_class(one, "shape_batch", "...", "fit_shapes()")
  given <- lapply(unname(given), renewed_batch)
  schemes <- Filter(Negate(is.null), lapply(given, attr, "scheme"))
  other <- which(vapply(schemes, `[[`, "", "key") != schemes[[1]]$key)
  if (length(other)) {
    crestline_abort(sprintf("the batches were measured by different schemes: %s, and another %s.",
                            schemes[[1]]$name, schemes[[other[1]]]$name),
                    "Measure all by one scheme: fit_shapes(..., scheme = ).", stage = "batch")
  }
  shapes <- do.call(c, lapply(given, plain_list))
  failed <- do.call(c, lapply(given, attr, "failed"))
  failed <- failed[!duplicated(names(failed), fromLast = TRUE)]
  # Which elements of joined batches stay: where an id failed in one and was measured in another,
  # the result, with a message
  ids <- names(shapes)
  there <- !vapply(shapes, is.null, NA)
  mended <- unique(ids[!there & ids %in% ids[there]])
  if (length(mended)) {
    crestline_inform(sprintf("Failures are replaced by results of: %s.", shorten(mended)))
  }
  # The last of several failures
  again <- !there & !duplicated(ids, fromLast = TRUE) | there
  stay <- again & (there | !ids %in% mended)
  # In the order in which the ids come first
  keep <- order(match(ids, ids))[stay[order(match(ids, ids))]]
  joined <- validate_shape_batch(new_shape_batch(
    shapes[keep], failed[!names(failed) %in% names(which(!vapply(shapes[keep], is.null, NA)))],
    if (length(schemes)) schemes[[1]], unlist(lapply(given, attr, "read"))
  ))
  warn_units(joined)
  tell_twins(joined, "batch")
  joined
}

#' Tell of specimens of a batch that were measured in different units
#' @noRd
warn_units <- function(batch) {
  unit <- vapply(plain_list(batch), function(one) told_of(one)$unit, 0)
  unit <- unit[!is.na(unit)]
  if (length(unique(unit)) < 2) return(invisible())
  usual <- as.numeric(names(which.max(table(unit))))
  odd <- names(unit)[unit != usual]
  crestline_warn(
    sprintf("the specimens are in different units: %s %s not in that of the others.",
            shorten(odd), if (length(odd) == 1) "is" else "are"),
    unit_remedy(odd[1], unit[[odd[1]]] / usual), stage = "batch", class = "crestline_unit_warning"
  )
}

#' @export
as.list.shape_batch <- function(x, ...) stats::setNames(
  lapply(seq_along(names(x)), function(i) x[[i]]), names(x)
)

#' @export
summary.shape_batch <- function(object, ...) {
  x <- renewed_batch(object)
  failed <- failures(x)
  at <- match(names(x), failed$id)
  told <- lapply(plain_list(x), told_of)
  landmarks <- ifelse(vapply(told, `[[`, NA, "found"), "found", "placed")
  lacking <- vapply(told, function(one) as.integer(one$lacking[1]), 0L)
  count <- as.vector(table(factor(warnings_of(x)$id, names(x))))
  data.frame(specimen = names(x), measured = is.na(at),
             landmarks = unname(ifelse(is.na(at), landmarks, NA)),
             lacking = unname(ifelse(is.na(at), lacking, NA)), warnings = count,
             message = failed$message[at])
}

#' @export
print.shape_batch <- function(x, most = 8, ...) {
  printed(x, {
    x <- renewed_batch(x)
    failed <- failures(x)
    files <- unlist(lapply(plain_list(x), attr, "file"))
    cat("<shape_batch> ", amount(length(x), "specimen"), ": ", length(x) - nrow(failed),
        " measured, ", nrow(failed), " failed",
        if (length(files)) paste0(", in ", shorten(unique(dirname(files)), 2)), "\n", sep = "")
    read <- length(intersect(attr(x, "read"), names(x)))
    if (read) {
      cat("  ", read, " read from the folder, ", length(x) - nrow(failed) - read,
          " measured now\n", sep = "")
    }
    told <- sprintf("%s, %s: %s %s", failed$id, failed$stage, failed$message, failed$remedy)
    print_items(c(landmark_lines(plain_list(x)[setdiff(names(x), failed$id)]),
                  warning_lines(attr(failed, "warnings"))),
                most, "in warnings_of()")
    print_items(told, most, "in failures()")
    invisible(x)
  })
}

#' Lines: of which shapes landmarks were found, of which some are missing, which have red parts
#' @noRd
landmark_lines <- function(shapes) {
  told <- lapply(shapes, told_of)
  red <- Filter(function(one) isTRUE(one$red > 0), told)
  counts_red <- vapply(red, function(one) as.numeric(one$red), 0)
  found <- names(shapes)[vapply(told, `[[`, NA, "found")]
  lacking <- Filter(function(one) one$lacking[1] > 0, told)
  counts <- vapply(lacking, function(one) paste(one$lacking, collapse = " of "), "")
  c(if (length(found)) {
      sprintf("%s: landmarks found by the template, not placed by hand: %s.",
              amount(length(found), "specimen"), shorten(found, 12))
    },
    if (length(lacking)) {
      sprintf("%s: landmarks of the scheme are missing: %s.", amount(length(lacking), "specimen"),
              shorten(sprintf("%s (%s)", names(lacking), counts), 12))
    },
    if (length(red)) {
      sprintf("%s with red parts, see quality(): %s.", amount(length(red), "specimen"),
              shorten(sprintf("%s (%d)", names(red), counts_red), 12))
    })
}

print_items <- function(lines, most, where) {
  for (line in utils::head(lines, most)) cat(strwrap(paste0("- ", line), width = 80, exdent = 4),
                                             sep = "\n")
  if (length(lines) > most) cat("- and", length(lines) - most, "more", where, "\n")
}

#' @param job,run What was to be measured and how, as in [fit_jobs()]; NULL where that is not known.
#' @noRd
new_failure <- function(stage, message, remedy, warnings = no_warnings(), fault = FALSE,
                        job = NULL, run = NULL) {
  structure(list(stage = stage, message = message, remedy = remedy, warnings = warnings,
                 fault = fault, job = job, run = run),
            class = "shape_failure")
}

#' Failed specimens of a batch
#'
#' Lists the specimens that could not be measured, with the reason and the remedy. After a remedy,
#' measure the failed specimens again, and join the results: `shapes <- c(shapes,
#' fit_shapes(files["anna"], found = TRUE))`.
#'
#' @param x A `shape_batch`, as [fit_shapes()] returns it.
#' @return Data frame with a row for each failed specimen: `id`, `stage` (of the measurement),
#'   `message` (the error), `remedy`. A batch in files also has a row for each specimen whose file
#'   is damaged or missing, or has another result now. Attribute `warnings`: the data frame of
#'   [warnings_of()].
#' @section Errors: of class `crestline_error`: `x` is not a batch.
#' @template glossary
#' @seealso [warnings_of()] for the warnings of specimens that were measured.
#' @examplesIf rlang::is_installed(c("future", "progressr"))
#' bad <- tempfile(fileext = ".ply")
#' writeLines("no mesh", bad)
#' curve <- data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 7)
#' scheme <- curve_scheme(data.frame(landmark = c("a", "b")), curve, name = "one line")
#' failures(fit_shapes(bad, scheme))
#' @export
failures <- function(x) {
  check_given()
  check_class(x, "shape_batch", "x", "fit_shapes()")
  x <- renewed_batch(x)
  elements <- unclass(x)
  failed <- attr(x, "failed")
  kept <- names(x)[vapply(elements, inherits, NA, "kept_shape")]
  touched <- kept[!untouched(elements[kept])]
  faults <- Filter(Negate(is.null), lapply(elements[touched], kept_fault))
  lost <- c(failed[intersect(names(x), names(failed))], faults)
  lost <- lost[order(match(names(lost), names(x)))]
  text <- function(field) vapply(lost, function(one) as.character(one[[field]])[1], "",
                                 USE.NAMES = FALSE)
  rows <- data.frame(id = as.character(names(lost)), stage = text("stage"),
                     message = text("message"), remedy = text("remedy"))
  structure(rows, warnings = warnings_of(x))
}

#' Warnings of measured specimens
#'
#' Lists the warnings of reading, finding and fitting, for each specimen of a batch. A warning does
#' not stop [fit_shapes()]; it is stored with the shape (`shape$warnings`). A single call of
#' [specimen()] or [fit_shape()] gives its warnings at once, and stores none.
#'
#' @param x A `shape_batch`, as [fit_shapes()] returns it; a `shape`; or a list of shapes.
#' @return Data frame with a row for each warning, those of failed specimens included. Columns are
#'   `id`, `stage` (of the measurement), `class` (first class of the condition, such as
#'   `"crestline_mirrored"`), `problem`, and `remedy` ("" for a warning of another package).
#' @section Errors: of class `crestline_error`: `x` has no shapes.
#' @template glossary
#' @seealso [failures()], [quality()]
#' @examplesIf rlang::is_installed(c("future", "progressr"))
#' # Left and right are mirrored.
#' corners <- rbind(aL = c(-1, -1, 2), aR = c(1, -1, 2), top = c(0, 2, 2), low = c(0, -2, 2))
#' corners <- corners / sqrt(rowSums(corners^2))
#' file <- file.path(tempfile(), "ball.ply")
#' dir.create(dirname(file))
#' Rvcg::vcgPlyWrite(Rvcg::vcgSphere(4), file)
#' curve <- data.frame(curve = "across", from = "aL", to = "aR", kind = "plane", n = 7)
#' scheme <- curve_scheme(data.frame(landmark = rownames(corners)), curve, name = "across")
#' shapes <- fit_shapes(file, scheme, landmarks = list(ball = corners),
#'                      reading = list(midline = c("top", "low")))
#' warnings_of(shapes)
#' @export
warnings_of <- function(x) {
  if (inherits(x, "shape_batch")) return(batch_warnings(renewed_batch(x)))
  shapes <- named_shapes(x)
  bind_warnings(lapply(shapes, function(shape) shape$warnings))
}

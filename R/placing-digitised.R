# What comes of a desk: marks, steps and specimens, and the array that other programs take.

#' Where the specimens of a desk come from: by id a path, a specimen or a mesh
#' @noRd
desk_sources <- function(specimens) {
  if (inherits(specimens, c("specimen", "mesh3d"))) specimens <- list(specimens)
  if (is.character(specimens) && length(specimens) && all(vapply(specimens, is_path, NA))) {
    ids <- sub("(.)[.][^.]*$", "\\1", basename(specimens))
    sources <- as.list(unname(specimens))
  } else if (is.list(specimens) && length(specimens)) {
    for (one in specimens) check_surface(one, "specimens")
    given <- names(specimens)
    ids <- vapply(seq_along(specimens), function(i) {
      own <- if (inherits(specimens[[i]], "specimen")) specimens[[i]]$id
      c(given[i][nzchar(c(given[i], "")[1])], own, paste("specimen", i))[1]
    }, "")
    sources <- unname(specimens)
  } else {
    refuse_argument("specimens", specimens, "Give paths of meshes, or a list of specimens.")
  }
  twice <- unique(ids[duplicated(ids)])
  if (length(twice)) {
    crestline_abort(sprintf("`specimens` has two named %s.", shorten(twice)),
                    "Give a list with a name of its own for each.", stage = "arguments")
  }
  stats::setNames(sources, ids)
}

#' The desk of some sources: each is opened, and resumed from its record, when its turn comes
#' @noRd
desk_from <- function(sources, scheme, dir, observer, blank, settings, page) {
  open <- function(id) {
    source <- sources[[id]]
    one <- if (is.character(source)) {
      read_specimen(source, if (!blank) landmarks_beside(source), id)
    } else if (inherits(source, "specimen")) {
      with_fields(source, id = id)
    } else specimen(source, id = id)
    if (blank) one <- without_landmarks(one, scheme)
    own <- scheme_in_unit(scheme, NULL, one)
    review <- begin_review(one, own, find_settings()$low, settings, page$bridge,
                           getOption("crestline.threads", 1L), observer)
    review <- with_drawn(review)
    review$selected <- next_open(review)
    if (is.null(dir)) review else
      resumed_review(review, desk_paths(dir, observer, id)$record)
  }
  keep <- if (is.null(dir)) function(review) NULL else function(review) keep_review(review, dir)
  begin_desk(names(sources), open, keep, observer)
}

new_digitised <- function(marks, steps, specimens) {
  rownames(marks) <- rownames(steps) <- NULL
  structure(list(marks = marks, steps = steps, specimens = specimens), class = "digitised")
}

#' @noRd
digitised_from <- function(desk) {
  reviews <- Filter(Negate(is.null), desk$reviews[desk$ids])
  specimens <- lapply(reviews, reviewed_specimen)
  marks <- do.call(rbind, lapply(reviews, function(review) {
    at <- review$specimen$landmarks
    row <- match(names(review$state), rownames(at))
    digitised_marks(review$specimen$id, review$observer, names(review$state),
                    unname(review$state), at[row, , drop = FALSE], drawn_points(review),
                    vapply(review$drawn, `[[`, NA, "snapped")) |>
      with_last_steps(review$log)
  }))
  steps <- do.call(rbind, lapply(reviews, function(review) {
    steps_of(review$specimen$id, review$observer, review$log)
  }))
  new_digitised(marks, steps, specimens)
}

#' The rows of one specimen by one observer
#'
#' @param at k x 3, of the landmarks.
#' @param curves As of [drawn_points()].
#' @param snapped Logical by curve.
#' @noRd
digitised_marks <- function(specimen, observer, landmarks, state, at, curves, snapped) {
  rows <- function(level, part, point, xyz, state) {
    data.frame(specimen = rep(specimen, length(part)), observer = rep(observer, length(part)),
               level = rep(level, length(part)), part = part, point = point,
               x = unname(xyz[, 1]), y = unname(xyz[, 2]), z = unname(xyz[, 3]),
               state = rep_len(state, length(part)))
  }
  lines <- lapply(names(curves), function(name) {
    n <- nrow(curves[[name]])
    rows("curves", rep(name, n), seq_len(n), curves[[name]],
         if (isTRUE(snapped[[name]])) "snapped" else "drawn")
  })
  do.call(rbind, c(list(rows("landmarks", landmarks, rep(1L, length(landmarks)), at, state)),
                   lines))
}

#' The rows of one specimen with what was done last to each part, and when
#' @param steps As of [no_steps()].
#' @noRd
with_last_steps <- function(marks, steps) {
  last <- steps[!duplicated(steps[c("level", "part")], fromLast = TRUE), ]
  row <- match(paste(marks$level, marks$part), paste(last$level, last$part))
  cbind(marks, last[row, c("action", "time")], row.names = NULL)
}

steps_of <- function(specimen, observer, steps) {
  data.frame(specimen = rep(specimen, nrow(steps)), observer = rep(observer, nrow(steps)),
             steps[c("part", "level", "action", "time")])
}

record_marks <- function(record, dir) {
  marks <- record$landmarks
  curves <- recorded_curves(record, desk_paths(dir, record$observer, record$specimen)$table)
  snapped <- stats::setNames(vapply(record$curves, `[[`, NA, "snapped"),
                             vapply(record$curves, `[[`, "", "curve"))
  digitised_marks(record$specimen, record$observer, marks$landmark, marks$state,
                  as.matrix(marks[c("x", "y", "z")]), curves, snapped) |>
    with_last_steps(record$steps)
}

record_steps <- function(record) steps_of(record$specimen, record$observer, record$steps)

#' The specimens of records, by the meshes they were made on: a desk opened again at each
#'
#' @param sources As of [desk_sources()].
#' @noRd
recorded_specimens <- function(records, sources, scheme, dir) {
  who <- vapply(records, `[[`, "", "observer")
  id <- vapply(records, `[[`, "", "specimen")
  own <- which(id %in% names(sources))
  lost <- setdiff(names(sources), id)
  if (length(lost)) {
    crestline_inform(sprintf("%s no record in %s: %s.",
                             amount(length(lost), "specimen has", "specimens have"), dir,
                             shorten(lost)))
  }
  each <- lapply(own, function(i) {
    desk <- desk_from(sources[id[i]], scheme, dir, who[i], TRUE, ridge_settings(error = FALSE),
                      review_settings())
    reviewed_specimen(current_review(desk))
  })
  stats::setNames(each, if (length(unique(who)) > 1) paste(id, who)[own] else id[own])
}

#' @rdname digitise
#' @export
as.data.frame.digitised <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  x$marks
}

#' @rdname digitise
#' @export
as.array.digitised <- function(x, level = c("landmarks", "curves"), ...) {
  check_method_dots(...)
  level <- check_names(level, "level")
  if (!all(level %in% c("landmarks", "curves"))) {
    refuse_argument("level", level, "Give \"landmarks\", \"curves\", or both.")
  }
  marks <- x$marks[x$marks$level %in% level, ]
  several <- length(unique(marks$observer)) > 1
  who <- if (several) paste(marks$specimen, marks$observer) else marks$specimen
  name <- ifelse(marks$level == "landmarks", marks$part, paste(marks$part, marks$point))
  names <- unique(name)
  sets <- unique(who)
  array <- array(NA_real_, c(length(names), 3, length(sets)),
                 list(names, c("x", "y", "z"), sets))
  row <- match(name, names)
  set <- match(who, sets)
  for (i in 1:3) array[cbind(row, i, set)] <- marks[[c("x", "y", "z")[i]]]
  array
}

#' @export
print.digitised <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    each <- unique(x$marks[c("specimen", "observer")])
    cat(sprintf("<digitised> %s, %s\n", amount(length(unique(each$specimen)), "specimen"),
                amount(length(unique(each$observer)), "observer")))
    for (i in seq_len(nrow(each))) {
      own <- x$marks[x$marks$specimen == each$specimen[i] & x$marks$observer == each$observer[i], ]
      marks <- own[own$level == "landmarks", ]
      lines <- unique(own[own$level == "curves", c("part", "state")])
      cat(sprintf("  %s%s: %d of %s, %s drawn (%d snapped)\n", each$specimen[i],
                  if (nzchar(each$observer[i])) paste(" by", each$observer[i]) else "",
                  sum(!is.na(marks$x)), amount(nrow(marks), "landmark"),
                  amount(nrow(lines), "curve"), sum(lines$state == "snapped")))
    }
    invisible(x)
  })
}

# What the page of a scheme that is being built knows and does, without a page.

#' Begin to build a scheme
#'
#' @param specimen A specimen; its landmarks are those that there are.
#' @param scheme A [curve_scheme()] to go on with, or NULL.
#' @param settings List: `ridge` ([ridge_settings()]), `bridge`, `threads`, `radius` (of suggestions
#'   and snaps), `name`.
#' @return List: `specimen`; `curves`, `patches`, `pairs`, `words` (tables of the scheme; `words` is
#'   that of landmarks); `fitting` as of [begin_fitting()], NULL without curves; `surface` (list by
#'   patch: `points`, `reason`); `selected` (name of a landmark, or none); `chain` (landmarks of the
#'   next curve); `curve` (name of the curve whose row is shown); `suggested` (as of
#'   [suggest_landmarks()], or NULL); `said` (text); `settings`; `history`.
#' @noRd
begin_build <- function(specimen, scheme, settings) {
  state <- list(specimen = with_located(specimen), curves = scheme$curves,
                patches = scheme$patches, pairs = scheme$pairs, words = scheme$landmarks,
                fitting = NULL, surface = list(), selected = character(), chain = character(),
                curve = character(), suggested = NULL, said = "", settings = settings,
                history = list())
  refit_build(state)
}

#' The next state, from which the way back leads to this one
#' @noRd
build_step <- function(state, ..., said = "") {
  after <- state
  new <- list(...)
  after[names(new)] <- new
  after$said <- said
  kept <- c("specimen", "curves", "patches", "pairs", "words", "fitting", "surface", "selected",
            "chain", "curve")
  after$history <- c(state$history, list(state[kept]))
  after
}

undo_build <- function(state) {
  last <- length(state$history)
  if (last == 0) return(with_said(state, "There is nothing to undo."))
  # Fields that were NULL are kept as such.
  state[names(state$history[[last]])] <- state$history[[last]]
  state$history <- state$history[-last]
  with_said(state, "Undone.")
}

#' The state after a change; after one that fails the same state, which says why
#' @noRd
try_build <- function(state, change) {
  after <- as_value(change(state))
  if (failed(after)) with_said(state, paste(after$problem, after$remedy)) else after
}

refuse_build <- function(problem, remedy) {
  crestline_abort(problem, remedy, stage = "scheme", class = "crestline_scheme_error", call = NULL)
}

# ---- Landmarks

#' The first name of the form L1, L2, ... that is free
#' @noRd
free_name <- function(taken, stem) {
  names <- paste0(stem, seq_len(length(taken) + 1))
  setdiff(names, taken)[1]
}

build_names <- function(state) as.character(rownames(state$specimen$landmarks))

#' Put a landmark on a place of the mesh, a new one or one that there is
#'
#' @param point One row of [surface_points()].
#' @param snap As `to` of [snap()].
#' @noRd
place_mark <- function(state, name, point, snap = "surface") {
  name <- checked_name(name)
  said <- ""
  if (snap != "surface") {
    r <- state$settings$radius
    source <- known_curvature(NULL, state$specimen, r, state$settings$threads, "adaptive cubic")
    faint <- formals(crestline::snap)$faint
    found <- snapped_place(walkable(state$specimen), point, snap, r, r, faint, source)
    if (is.null(found)) {
      said <- sprintf("There is no %s within %.3g of %s: it is where you clicked.", snap, r, name)
    } else {
      point <- found$place
    }
  }
  was <- name %in% build_names(state)
  after <- build_step(state, specimen = move_landmark(state$specimen, name, point),
                      selected = name, said = said)
  if (was) refit_build(after, moved = name) else after
}

checked_name <- function(name) {
  name <- trimws(c(name, "")[1])
  if (!nzchar(name)) refuse_build("The landmark has no name.", "Write one.")
  if (grepl("[][+|; ]", name)) {
    refuse_build(sprintf("The name %s has a blank, a bracket, or one of + | ;.", name),
                 "Write it without.")
  }
  name
}

#' Another name for a landmark, in every table
#' @noRd
rename_mark <- function(state, from, to) {
  to <- checked_name(to)
  if (identical(from, to) || !length(from)) return(state)
  if (to %in% build_names(state)) refuse_build(sprintf("There is a landmark %s.", to),
                                               "Give another name.")
  swap <- function(x) ifelse(x == from, to, x)
  specimen <- state$specimen
  known <- specimen$geometry
  rownames(known$landmarks) <- swap(rownames(known$landmarks))
  landmarks <- specimen$landmarks
  rownames(landmarks) <- swap(rownames(landmarks))
  origin <- specimen$origin
  origin$landmark <- swap(origin$landmark)
  specimen <- with_fields(specimen, landmarks = landmarks, geometry = known, origin = origin)
  curves <- state$curves
  by_name <- intersect(names(curves), c("from", "to", "cut_from", "cut_to", "keep_away_from",
                                        "keep_away_to", "keep_side_from", "keep_side_to",
                                        "keep_side_towards"))
  curves[by_name] <- lapply(curves[by_name], swap)
  curves$via <- swapped_via(curves$via, swap)
  pairs <- state$pairs
  marks <- pairs$level %in% "landmarks"
  pairs[marks, c("left", "right")] <- lapply(pairs[marks, c("left", "right")], swap)
  words <- state$words
  if (!is.null(words)) words$landmark <- swap(words$landmark)
  after <- build_step(state, specimen = specimen, curves = curves, pairs = pairs, words = words,
                      selected = to, chain = swap(state$chain))
  refit_build(after)
}

remove_mark <- function(state, name) {
  if (!length(name)) return(state)
  used <- curves_on(state$curves, name)
  if (length(used)) {
    refuse_build(sprintf("%s is on the curve %s.", name, shorten(used)), "Remove the curve first.")
  }
  specimen <- state$specimen
  known <- specimen$geometry
  row <- rownames(known$landmarks) != name
  known$landmarks <- known$landmarks[row, , drop = FALSE]
  known$located <- known$located[row, ]
  own <- rownames(specimen$landmarks) != name
  specimen <- with_fields(specimen, landmarks = specimen$landmarks[own, , drop = FALSE],
                          geometry = known,
                          origin = specimen$origin[specimen$origin$landmark != name, ])
  pairs <- state$pairs
  gone <- pairs$level %in% "landmarks" & (pairs$left == name | pairs$right == name)
  build_step(state, specimen = specimen, pairs = pairs[!gone, ], selected = character(),
             chain = setdiff(state$chain, name), said = sprintf("%s is removed.", name))
}

#' Names of the curves that a landmark is an end or a `via` of
#' @noRd
curves_on <- function(curves, name) {
  on <- vapply(seq_len(NROW(curves)), function(i) {
    name %in% c(curves$from[i], curves$to[i], via_names(curves$via[i]))
  }, NA)
  as.character(curves$curve[on])
}

#' Choose a landmark: it is selected, and the next of the chain
#' @noRd
pick_mark <- function(state, name) {
  if (!name %in% build_names(state)) return(state)
  # The first landmark of a new curve: the form is no longer that of another one.
  if (!length(state$chain)) state$curve <- character()
  if (!identical(name, utils::tail(state$chain, 1))) state$chain <- c(state$chain, name)
  state$selected <- name
  with_said(state, "")
}

#' Landmarks that curvature suggests, to choose from
#' @noRd
suggest_marks <- function(state) {
  if (!is.null(state$suggested)) {
    state["suggested"] <- list(NULL)
    return(with_said(state, "Suggestions are hidden."))
  }
  state$suggested <- suggest_landmarks(state$specimen, state$settings$radius,
                                       threads = state$settings$threads)
  with_said(state, sprintf("%s in grey. A click on one puts a landmark there.",
                           amount(nrow(state$suggested), "suggestion")))
}

# ---- Curves, patches, pairs

#' Join the landmarks of the chain by a curve; a curve of that name is replaced
#'
#' @param row List: `curve` (name), `kind`, `path`, `closed`, `radius`, `width`, `n`.
#' @noRd
join_curve <- function(state, row) {
  chain <- state$chain
  old <- match(row$curve, state$curves$curve)
  closed <- isTRUE(row$closed)
  if (length(chain) < 2 && is.na(old)) {
    refuse_build("Fewer than two landmarks are chosen.", "Click on their balls, one after another.")
  }
  row$curve <- trimws(row$curve)
  if (!nzchar(row$curve)) row$curve <- free_name(state$curves$curve, "curve ")
  new <- list(curve = row$curve, kind = row$kind, n = row$n)
  if (length(chain) >= 2) {
    via <- if (closed) chain[-1] else chain[-c(1, length(chain))]
    new$from <- chain[1]
    new$to <- if (closed) chain[1] else chain[length(chain)]
    new$via <- if (length(via)) paste(via, collapse = " ") else NA_character_
    new$path <- if (length(via)) "crest" else row$path
  }
  plane <- row$kind == "plane"
  new[c("radius", "width")] <- if (plane) NA_real_ else row[c("radius", "width")]
  if (plane && length(via_names(new$via))) {
    refuse_build("A plane curve joins two landmarks only.", "Choose the two ends, or a ridge.")
  }
  if (plane) new$path <- NA_character_
  curves <- with_row_of(state$curves, new, if (is.na(old)) NROW(state$curves) + 1 else old)
  after <- build_step(state, curves = curves, chain = character(), curve = character())
  after <- refit_build(after)
  with_said(after, curve_words(after, row$curve))
}

#' A table with a row of given values in one place, NA in its other columns
#' @noRd
with_row_of <- function(table, values, at) {
  values <- as.data.frame(values)
  if (!NROW(table)) return(values)
  for (name in setdiff(names(values), names(table))) table[[name]] <- rep(NA, nrow(table))
  if (at > nrow(table)) {
    table[at, ] <- NA
    rownames(table) <- NULL
  }
  table[at, names(values)] <- values
  table
}

#' What there is to say of a curve: kind, length, strength, reason
#' @noRd
curve_words <- function(state, name) {
  fit <- state$fitting$fits[[name]]
  row <- state$curves[match(name, state$curves$curve), ]
  if (is.null(fit)) return(name)
  if (is.null(fit$path)) return(sprintf("%s is not there: %s", name, fit$reason))
  paste0(sprintf("%s: %s, %.4g long", name, row$kind, fit$length),
         if (!is.na(fit$strength)) sprintf(", strength %.3g", fit$strength),
         if (!is.na(fit$reason)) paste0("; ", fit$reason))
}

remove_curve <- function(state, name) {
  scheme <- state$fitting$scheme
  used <- vapply(unique(scheme$patches$patch), function(patch) {
    name %in% bounding_curves(patch, scheme)
  }, NA)
  if (any(used)) {
    refuse_build(sprintf("%s bounds the patch %s.", name, shorten(names(which(used)))),
                 "Remove the patch first.")
  }
  pairs <- without_pairs(state$pairs, "curves", name)
  after <- build_step(state, curves = state$curves[state$curves$curve != name, ], pairs = pairs,
                      curve = character(), said = sprintf("%s is removed.", name))
  refit_build(after)
}

without_pairs <- function(pairs, level, name) {
  pairs[!(pairs$level %in% level & (pairs$left == name | pairs$right == name)), ]
}

#' Bound a patch by two curves
#'
#' Its columns run from the points of the one to those of the other, in the order that makes them
#' shorter; ends that both curves share make no column.
#' @param rows Number of points of a column.
#' @noRd
bound_patch <- function(state, name, a, b, rows) {
  name <- trimws(name)
  if (!nzchar(name)) name <- free_name(state$patches$patch, "patch ")
  if (identical(a, b)) refuse_build("A patch needs two different curves.", "Choose another one.")
  points <- lapply(c(a, b), function(curve) state$fitting$fits[[curve]]$points)
  if (any(vapply(points, is.null, NA))) {
    refuse_build("One of the two curves is not there.", "Mend it first.")
  }
  n <- nrow(points[[1]])
  xyz <- lapply(points, function(p) columns_of(p, c("x", "y", "z")))
  other <- xyz[[2]][round(seq(1, nrow(xyz[[2]]), length.out = n)), ]
  turned <- sum(row_lengths(xyz[[1]] - other)) > sum(row_lengths(xyz[[1]] - other[n:1, ]))
  if (turned) other <- other[n:1, ]
  m <- nrow(xyz[[2]])
  apart <- which(row_lengths(xyz[[1]] - other) > 1e-9 * mesh_diagonal(state$specimen$mesh))
  kept <- range(apart)
  row <- list(patch = name, n = as.integer(diff(kept) + 1) * rows,
              columns = sprintf("%d:%d", kept[1], kept[2]), rows = rows,
              rows_kept = sprintf("1:%d", rows), curve_a = sprintf("%s[1:%d]", a, n),
              curve_b = sprintf(if (turned) "%s[%d:1]" else "%s[1:%d]", b, m),
              resample_b = if (m == n) NA_integer_ else n,
              outward = patch_order(xyz[[1]], other, points[[1]]$face, state$specimen$mesh))
  old <- match(name, state$patches$patch)
  patches <- with_row_of(state$patches, row, if (is.na(old)) NROW(state$patches) + 1 else old)
  after <- refit_build(build_step(state, patches = patches))
  reason <- after$surface[[name]]$reason
  with_said(after, sprintf("%s: %d points%s", name, row$n,
                           if (is.na(reason)) "" else paste0("; ", reason)))
}

#' The order of a quad's corners as seen from outside
#' @noRd
patch_order <- function(a, b, face, mesh) {
  i <- max(1, nrow(a) %/% 2)
  corner <- t(mesh$vb[1:3, mesh$it[, face[i]]])
  normal <- cross_product(corner[2, ] - corner[1, ], corner[3, ] - corner[1, ])
  along <- a[i + 1, ] - a[i, ] + b[i + 1, ] - b[i, ]
  if (sum(cross_product(along, b[i, ] - a[i, ]) * normal) > 0) "columns" else "rows"
}

remove_patch <- function(state, name) {
  after <- build_step(state, patches = state$patches[state$patches$patch != name, ],
                      pairs = without_pairs(state$pairs, "surface", name),
                      said = sprintf("%s is removed.", name))
  refit_build(after)
}

#' Propose the left-right pairs: of landmarks by their mirror images, and what follows from them
#' @noRd
propose_pairs <- function(state) {
  pairs <- mirror_pairs(state$specimen$landmarks)
  if (!nrow(pairs)) {
    refuse_build("No plane mirrors most of the landmarks onto each other.",
                 "Place the landmarks of both sides first.")
  }
  curves <- if (NROW(state$curves)) state$curves else empty_curves()
  pairs <- pairs_of_all(pairs, curves, state$patches)
  count <- table(factor(pairs$level, c("landmarks", "curves", "surface")))
  build_step(state, pairs = pairs, said = sprintf(
    "Pairs: %d of landmarks, %d of curves, %d of patches. Left is the one placed first.",
    count[1], count[2], count[3]
  ))
}

empty_curves <- function() {
  names <- names(scheme_columns$curves)
  as.data.frame(stats::setNames(rep(list(character()), length(names)), names))
}

# ---- The scheme, and what is fitted by it

#' The scheme of a state; NULL as long as it has no curve
#'
#' @param pairs Whether with pairs: they must be whole, which they need not be on the way.
#' @noRd
build_scheme_of <- function(state, pairs = FALSE) {
  if (!NROW(state$curves)) return(NULL)
  at <- state$specimen$landmarks
  landmarks <- data.frame(landmark = rownames(at), at, row.names = NULL)
  words <- state$words[setdiff(names(state$words), c("x", "y", "z", "landmark"))]
  if (length(words)) {
    landmarks <- cbind(landmarks, words[match(landmarks$landmark, state$words$landmark), ,
                                        drop = FALSE])
  }
  curve_scheme(landmarks, state$curves, if (NROW(state$patches)) state$patches,
               if (pairs && NROW(state$pairs)) state$pairs, name = state$settings$name)
}

#' Fit what has changed
#'
#' @param moved Names of landmarks that moved; NULL: the scheme has changed.
#' @noRd
refit_build <- function(state, moved = NULL) {
  scheme <- build_scheme_of(state)
  if (is.null(scheme)) {
    state["fitting"] <- list(NULL)
    state$surface <- list()
    return(state)
  }
  set <- state$settings
  state$fitting <- if (is.null(moved)) {
    grow_fitting(state$fitting,
                 begin_fitting(state$specimen, scheme, set$ridge, set$bridge, set$threads))
  } else {
    refit_curves(state$fitting, state$specimen, moved)
  }
  state$surface <- fitted_patches(state$fitting)
  state
}

#' The patches of a scheme that is being built
#' @return List by patch: `points` (n x 3, column by column), `rows`, `reason`.
#' @noRd
fitted_patches <- function(fitting) {
  scan <- fitting$scan
  scheme <- fitting$scheme
  if (!NROW(scheme$patches)) return(list())
  scan$column <- column_settings(shape_settings())
  found <- fit_scheme_patches(scan, fitting$fits, place_store(scan, fitting$fits), function() NULL)
  surface <- scheme$points$level == "surface"
  at <- found$store[scheme_plan(scheme)$at[surface], c("x", "y", "z"), drop = FALSE]
  names <- unique(scheme$patches$patch)
  stats::setNames(lapply(names, function(name) {
    own <- scheme$patches$patch == name
    list(points = at[scheme$points$part[surface] == name, , drop = FALSE],
         rows = lengths(lapply(scheme$patches$rows_kept[own], number_list))[1],
         reason = patch_reason(found$problems[own]))
  }), names)
}

#' Write the folder that [read_scheme()] takes
#' @noRd
save_build <- function(state, dir) {
  if (!is_path(dir)) refuse_build("There is no folder to save to.", "Write its path.")
  if (!NROW(state$curves)) refuse_build("There is no curve yet.", "Join two landmarks first.")
  scheme <- as_value(build_scheme_of(state, pairs = TRUE))
  left_out <- if (failed(scheme)) {
    problem <- scheme$problem
    scheme <- build_scheme_of(state)
    paste(" Without pairs:", problem)
  }
  write_scheme(scheme, dir)
  with_said(state, paste0("Saved in ", normalizePath(dir), ".", left_out))
}

# The points of patches between slid curves: cut anew, then slid to the least energy, over the mesh
# or along their cuts.

#' The patches between slid curves
#'
#' @param cutting As of [cutting_of()].
#' @param store As of [curves_placed()].
#' @return The store with all places of patches, those that could not be cut NA.
#' @noRd
between_curves <- function(cutting, store) {
  points <- cutting$scheme$points
  store[setdiff(points$place, points$place[points$level != "surface"]), ] <- NA
  fit_scheme_patches(cutting$scan, cutting$fits, store, function() NULL)$store
}

#' Slide the points inside patches
#'
#' @param store,cutting As of [between_curves()].
#' @return List: `store`, `sliding`, `trace` as in [slide()].
#' @noRd
slide_surface <- function(store, cutting, plan) {
  trace <- list()
  longest <- numeric()
  before <- store
  for (set in if (plan$settings$surface != "between") surface_sets(store, plan)) {
    slid <- if (plan$settings$surface == "mesh") slide_free(set, store, cutting$specimen, plan) else
      slide_transects(set, store, cutting, plan)
    store <- slid$store
    trace[[set$name]] <- slid$trace
    moved <- store[set$free, c("x", "y", "z"),
                   drop = FALSE] - before[set$free, c("x", "y", "z"), drop = FALSE]
    longest[set$name] <- sqrt(max(rowSums(moved^2)))
  }
  list(store = store, trace = lapply(trace, trace_table),
       sliding = sliding_table(trace, "surface", longest))
}

#' The sets of surface points that slide in one energy: one of all, or one a patch
#'
#' @return List of sets: `name`, `places` (rows of `b`), `free` (those of them that slide), `b`.
#' @noRd
surface_sets <- function(store, plan) {
  points <- plan$scheme$points
  surface <- points[points$level == "surface", ]
  groups <- if (plan$settings$surface_energy == "all") list(surface = unique(points$place)) else
    lapply(split(surface$place, factor(surface$part, unique(surface$part))), unique)
  there <- !is.na(store[, "x"]) & !is.na(plan$xyz[rownames(store), 1])
  free <- names(which(there & !rownames(store) %in% bound_places(plan$scheme)))
  sets <- Map(function(name, group) {
    own <- group[there[group]]
    if (!any(own %in% free)) return(NULL)
    kept(plan, list("surface", name, group[!there[group]]), function() {
      list(name = name, places = own, free = intersect(own, free),
           b = set_energy(own, plan, plan$settings$surface_nugget))
    })
  }, names(groups), groups)
  Filter(Negate(is.null), sets)
}

#' Places that landmarks and curves hold: their own, and those of patches that lie on bounding
#' curves
#' @noRd
bound_places <- function(scheme) {
  points <- scheme$points
  held <- points$place[points$level != "surface"]
  blocks <- lapply(scheme_plan(scheme)$blocks, function(block) {
    block$row == 1 | (block$row == block$rows & !is.null(block$b)) |
      (block$column == 1 & !is.null(block$first))
  })
  unique(c(held, points$place[points$level == "surface"][unlist(blocks)]))
}

#' Slide a set over the mesh
#' @noRd
slide_free <- function(set, store, specimen, plan) {
  settings <- plan$settings
  surface <- walkable(specimen)
  free <- match(set$free, set$places)
  x <- store[set$places, c("x", "y", "z"), drop = FALSE]
  held <- set$b[free, -free, drop = FALSE] %*% x[-free, , drop = FALSE]
  slid <- cpp_slide_on_mesh(
    surface$vb, surface$it, surface$twin, set$b[free, free, drop = FALSE], x[free, , drop = FALSE],
    held, store[set$free, c("face", "w1", "w2", "w3"), drop = FALSE],
    settings$surface_tolerance * plan$radius, settings$surface_sweeps
  )
  rest <- quadratic_form(set$b[-free, -free, drop = FALSE], x[-free, , drop = FALSE])
  slid$trace$energy <- slid$trace$energy + rest
  store[set$free, mesh_columns] <- slid$points
  list(store = store, trace = c(slid$trace, points = length(free)))
}

#' Slide a set along the cuts that its points were made on
#' @noRd
slide_transects <- function(set, store, cutting, plan) {
  cuts <- transects(set, store, cutting, plan$settings)
  if (!length(cuts)) return(list(store = store, trace = NULL))
  rows <- stack_rows(lapply(cuts, `[[`, "rows"))
  slid <- cpp_slide_on_tracks(
    set$b, store[set$places, c("x", "y", "z"), drop = FALSE], lapply(cuts, `[[`, "track"), rows, 0,
    plan$settings$sweeps
  )
  at <- split(slid$s, rows[, "track"])
  mesh <- cutting$specimen$mesh
  for (i in seq_along(cuts)) {
    track <- cuts[[i]]$track
    store[cuts[[i]]$place, mesh_columns] <- cpp_place_along(
      mesh$vb, mesh$it, track[, 2:4], track[, 1], track[, 5], at[[i]]
    )
  }
  list(store = store, trace = c(slid$trace, points = length(slid$s)))
}

#' The cuts that the free points of a set were made on
#'
#' @return List of cuts: `place` (of the free points, in order), `track` and `rows` (as the kernel
#'   takes them).
#' @noRd
transects <- function(set, store, cutting, settings) {
  plan <- scheme_plan(cutting$scheme)
  each <- lapply(plan$blocks, function(block) {
    grid <- data.frame(column = block$column, row = block$row, place = plan$places[block$place])
    grid <- grid[grid$place %in% set$free, ]
    if (nrow(grid)) {
      # The cuts of one block with free points
      ground <- list(scan = cutting$scan, fits = cutting$fits, store = store)
      side <- function(side) side_points_on(side, side$n, ground)$points
      a <- side(block$a)
      b <- side(block$b)
      lapply(split(grid, grid$column), function(rows) {
        column <- rows$column[1]
        outside <- as.matrix(column_outside(a, b, column, block$outward))
        made <- fit_columns(a[column, , drop = FALSE], b[column, , drop = FALSE], outside,
                            block$rows, cutting$scan)
        track <- made$cuts[[1]]
        length <- track[nrow(track), 1]
        s <- rep(NA_real_, block$rows)
        s[c(1, rows$row, block$rows)] <- c(
          0, track_places(track, store[rows$place, c("x", "y", "z"), drop = FALSE]), length
        )
        sliders <- slider_rows(
          s, seq_len(block$rows) %in% rows$row, length / (block$rows - 1), length, settings
        )
        sliders[, "point"] <- match(rows$place, set$places)
        on_mesh <- track[, 5] <= cutting$scan$faces
        list(place = rows$place, track = cbind(track[, 1:4], ifelse(on_mesh, track[, 5], 0)),
             rows = sliders)
      })
    }
  })
  unlist(each, recursive = FALSE)
}

#' Arc lengths of the places of a polyline that are nearest to points
#'
#' @param track Matrix s, x, y, z, ...
#' @noRd
track_places <- function(track, xyz) {
  at <- nearest_on_polyline(xyz, track[, 2:4, drop = FALSE])
  track[at$segment, 1] + at$share * (track[at$segment + 1, 1] - track[at$segment, 1])
}

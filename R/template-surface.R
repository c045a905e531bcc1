# The points of patches between slid curves: cut anew, then slid to the least energy, over the mesh or along their cuts.

#' The patches between slid curves
#'
#' @param cutting List: `fits` (curves as [fit_scheme_patches()] takes them), `column`, `specimen`, `scheme`.
#' @param store As of [curves_placed()].
#' @return The store with all places of patches, those that could not be cut NA.
#' @noRd
between_curves <- function(cutting, store) {
  points <- cutting$scheme$points
  store[setdiff(points$place, points$place[points$level != "surface"]), ] <- NA
  fit_scheme_patches(cutting$specimen, cutting$scheme, cutting$fits, store, cutting$column, function() NULL)$store
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
    moved <- store[set$free, c("x", "y", "z"), drop = FALSE] - before[set$free, c("x", "y", "z"), drop = FALSE]
    longest[set$name] <- sqrt(max(rowSums(moved^2)))
  }
  list(store = store, trace = lapply(trace, trace_table), sliding = sliding_table(trace, "surface", longest))
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
    key <- paste(c("surface", name, group[!there[group]]), collapse = "|")
    kept(plan, key, function() {
      list(name = name, places = own, free = intersect(own, free), b = set_energy(own, plan, plan$settings$surface_nugget))
    })
  }, names(groups), groups)
  Filter(Negate(is.null), sets)
}

#' Places that landmarks and curves hold: their own, and those of patches that lie on bounding curves
#' @noRd
bound_places <- function(scheme) {
  points <- scheme$points
  held <- points$place[points$level != "surface"]
  blocks <- lapply(seq_len(nrow(scheme$patches)), function(i) {
    block <- scheme$patches[i, ]
    at <- block_points(block)
    at$row == 1 | (at$row == block$rows & !is.na(block$curve_b)) | (at$column == 1 & !is.na(block$first_column))
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
  slid <- cpp_slide_on_mesh(surface$vb, surface$it, surface$twin, set$b[free, free, drop = FALSE], x[free, , drop = FALSE], held,
                            store[set$free, c("face", "w1", "w2", "w3"), drop = FALSE], settings$surface_tolerance * plan$radius,
                            settings$surface_sweeps)
  rest <- quadratic_form(set$b[-free, -free, drop = FALSE], x[-free, , drop = FALSE])
  slid$trace$energy <- slid$trace$energy + rest
  store[set$free, mesh_columns] <- slid$points
  list(store = store, trace = c(slid$trace, points = length(free)))
}

#' Slide a set along the cuts that its points were made on
#' @noRd
slide_transects <- function(set, store, cutting, plan) {
  cuts <- transects(set, store, cutting)
  settings <- plan$settings
  slid <- cpp_slide_on_paths(set$b, store[set$places, c("x", "y", "z"), drop = FALSE], lapply(cuts, `[[`, "track"),
                             stack_rows(lapply(cuts, `[[`, "rows")), 0, settings$gap, settings$tolerance, settings$sweeps)
  at <- split(slid$s, rep(seq_along(cuts), lengths(lapply(cuts, `[[`, "place"))))
  for (i in seq_along(cuts)) {
    placed <- place_along(cutting$specimen$mesh, cuts[[i]]$path, at[[i]])
    store[cuts[[i]]$place, mesh_columns] <- columns_of(placed)
  }
  list(store = store, trace = c(slid$trace, points = length(slid$s)))
}

#' The cuts that the free points of a set were made on
#'
#' @return List of cuts: `place` (of the free points, in order), `path`, `track` (matrix s, x, y, z), `rows` (matrix for the kernel).
#' @noRd
transects <- function(set, store, cutting) {
  surface <- walkable(cutting$specimen)
  patches <- cutting$scheme$patches
  places <- split(cutting$scheme$points$place[cutting$scheme$points$level == "surface"],
                  rep(seq_len(nrow(patches)), patches$n))
  cuts <- list()
  for (i in which(vapply(places, function(place) any(place %in% set$free), NA))) {
    block <- patches[i, ]
    grid <- cbind(block_points(block), place = places[[i]])
    grid <- grid[grid$place %in% set$free, ]
    side <- function(text, resample) {
      block_side(text, resample, cutting$specimen, surface, cutting$scheme$curves, cutting$fits, store, cutting$column)$points
    }
    a <- side(block$curve_a, block$resample_a)
    b <- side(block$curve_b, block$resample_b)
    for (rows in split(grid, grid$column)) {
      column <- rows$column[1]
      path <- cut_between(a[column, ], b[column, ], cutting$specimen, surface, cutting$column)
      cuts[[length(cuts) + 1]] <- transect(rows$place, path, store, set$places, length(cuts) + 1, block$rows)
    }
  }
  cuts
}

transect <- function(place, path, store, places, number, rows) {
  track <- columns_of(path, c("s", "x", "y", "z"))
  s <- path_places(track, store[place, c("x", "y", "z"), drop = FALSE])
  list(place = place, path = path, track = track,
       rows = cbind(point = match(place, places), path = number, s = s, link_rows(length(place)),
                    rest = attr(path, "length") / (rows - 1)))
}

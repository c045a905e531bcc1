# Parts of paths, and a reference path that is believed in one part only.

#' The part of a path between two arc lengths; run backwards where the first is the greater
#' @noRd
part_of_path <- function(mesh, path, from, to) {
  range <- pmin(pmax(sort(c(from, to)), 0), attr(path, "length"))
  between <- columns_of(path)[path$s > range[1] & path$s < range[2], , drop = FALSE]
  ends <- columns_of(place_along(mesh, path, range))
  part <- path_through(rbind(ends[1, ], between, ends[2, ]), mesh_of(path))
  if (from > to) reversed_path(mesh, part) else part
}

#' A path run backwards: the face of a point is that of the segment that ends there
#' @noRd
reversed_path <- function(mesh, path) {
  n <- nrow(path)
  back <- columns_of(path)[n:1, ]
  back[-1, "face"] <- path$face[n:2]
  back[-1, 5:7] <- weights_in_faces(mesh, back[-1, "face"], back[-1, 1:3, drop = FALSE])
  path_through(back, mesh_of(path))
}

#' A reference path with the shortest cuts between the ends of its trusted part and the landmarks
#'
#' @param scan As of [walkable()].
#' @param trust Where the trusted part begins and ends, as shares of the path's length.
#' @return `mesh_path` with the attribute `trusted`, the arc lengths of that part; or a failure.
#' @noRd
trusted_path <- function(trust, scan, path) {
  if (trust[1] <= 0 && trust[2] >= 1) return(path)
  range <- trust * attr(path, "length")
  at <- columns_of(place_along(scan, path, range))
  ends <- columns_of(path)[c(1, nrow(path)), ]
  between <- function(from, to) {
    exact <- rbind(from, to)
    names <- c(end_name(from), end_name(to))
    find_reference(path_ends(scan, exact, names), "plane", NULL, NULL, search_settings())
  }
  parts <- list(
    if (trust[1] > 0) between(ends[1, ], at[1, ]),
    part_of_path(scan, path, range[1], range[2]),
    if (trust[2] < 1) between(at[2, ], ends[2, ])
  )
  bad <- Find(failed, parts)
  if (!is.null(bad)) return(bad)
  lengths <- vapply(parts, function(part) if (is.null(part)) 0 else attr(part, "length"), 0)
  points <- do.call(rbind, lapply(Filter(Negate(is.null), parts), columns_of))
  path_through(points, scan, trusted = cumsum(lengths)[1:2], type = attr(path, "type"),
               optima = attr(path, "optima"), competing = attr(path, "competing"))
}

check_trusted <- function(trust, call = rlang::caller_env()) {
  if (!is.numeric(trust) || length(trust) != 2 || !all(is.finite(trust)) || trust[1] < 0 ||
      trust[2] > 1 || trust[1] >= trust[2]) {
    crestline_abort(sprintf("`trust` is %s.", describe_value(trust)),
                    "Give two rising shares of the path, such as c(0, 0.75).", stage = "arguments",
                    call = call)
  }
  trust
}

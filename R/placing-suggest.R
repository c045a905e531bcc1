# Places of a mesh that would make landmarks: caps, cups, and ends and crossings of ridges.

#' Suggest landmarks
#'
#' Lists the places of a surface that curvature singles out: caps and cups, and the places where
#' ridges or valleys end or meet. Use it at the start of a scheme for an object of your own. A
#' suggestion is a place on one mesh. Whether other specimens have the same place is your decision.
#'
#' A *cap* (*cup*) is a place where the lesser of the two principal curvatures is strongest, as in
#' the definitions of [curve_scheme()]. Local fits put it between the vertices. A *crossing* is a
#' place from which three ridges (or valleys) or more leave. They are counted on a ring about the
#' place, whose radius is 1.5 times that of the curvature. The crossing is the place nearest to all
#' of these ridges. An *end* has one ridge on its ring, and the opposite half of the ring is weaker.
#' It lies on a vertex.
#'
#' Of several places of one kind within `apart` only the strongest is kept. Strengths of different
#' kinds do not compare: there a cap or cup is kept before a crossing, and a crossing before an end.
#' Near a border
#' (within 1.75 radii) there are no suggestions. The answer does not change if the mesh is moved or
#' turned, if mesh and radius are rescaled, or if the vertices are in another order.
#'
#' @param mesh A [specimen()], or a `mesh3d` with outward normals.
#' @param radius Radius of the curvature, in the unit of the mesh: about the size of the features.
#' @param n Greatest number of suggestions of each kind; the strongest are kept.
#' @param kinds Kinds of places, some of "cap", "cup", "crossing" and "end".
#' @param apart Least distance between two suggestions, in radii.
#' @param faint Places weaker than this value times 1 / radius are left out (no unit).
#' @param share A ridge leaves the place in a direction if its strength on the ring is at least this
#'   share of the strength at the place. An end needs less than this share in the opposite half.
#' @inheritParams curvature
#' @return Data frame of class `suggested_landmarks`, by kind, the strongest of each first:
#'   * `landmark`: a name, such as "cap1"; `kind`: "cap", "cup", "crossing" or "end";
#'   * `strength`, in 1 / unit. Cap and cup: the lesser principal curvature. Crossing: the strength
#'     of its third strongest ridge on the ring. End: the strength at the place, less the greatest
#'     strength in the opposite half;
#'   * `shape_index` (no unit) and `curvedness` (1 / unit) at the closest vertex;
#'   * `reason`: text;
#'   * `x`, `y`, `z` (unit of the mesh), `face`, `w1`, `w2`, `w3`: the place on the mesh.
#'
#'   `plot(suggested, mesh)` shows them; see [plot.suggested_landmarks()].
#' @section Errors: of class `crestline_error`: as of [curvature()], or an argument is wrong.
#' @template glossary
#' @seealso [snap()], [check_scheme()], [build_scheme()]
#' @examples
#' data(humface, package = "Rvcg")
#' suggested <- suggest_landmarks(humface, radius = 10, n = 5)
#' suggested
#' face <- specimen(humface, suggested, id = "humface")
#' @export
suggest_landmarks <- function(mesh, radius, n = 10, kinds = c("cap", "cup", "crossing", "end"),
                              apart = 2, faint = 0.05, share = 0.5,
                              threads = getOption("crestline.threads", 1L)) {
  check_given()
  check_surface(mesh, "mesh")
  n <- check_count(n, "n")
  kinds <- check_choices(kinds, c("cap", "cup", "crossing", "end"), "kinds")
  apart <- check_number(apart, "apart", 0)
  faint <- check_number(faint, "faint", 0)
  share <- check_number(share, "share", 0, 1, open = TRUE)
  curved <- curvature(mesh, radius, "adaptive cubic", threads = threads)
  scan <- walkable(mesh)
  field <- suggestion_field(scan, curved, radius, faint)
  round <- lapply(intersect(c("cap", "cup"), kinds), rounded_places, field)
  long <- lapply(c("ridge", "valley"), line_places, field, kinds, share)
  found <- do.call(rbind, c(list(no_suggestion(matrix(0, 0, 3))), round, long))
  found <- sparse_places(found, c("cap", "cup", "crossing", "end"), apart * radius, n)
  new_suggestions(found, scan, curved, radius)
}

#' What suggestions are sought in
#'
#' @param scan As of [walkable()].
#' @param margin Distance from a border within which there are none, in radii; the ring's outer
#'   radius.
#' @return List: `at` (n x 3), `curved`, `radius`, `least` (strength), `inner` (logical, vertices
#'   away from borders).
#' @noRd
suggestion_field <- function(scan, curved, radius, faint, margin = 1.75) {
  at <- t(scan$vb[1:3, , drop = FALSE])
  border <- border_vertices(scan$it, scan$twin)
  inner <- rep(TRUE, nrow(at))
  if (length(border)) {
    near <- Rvcg::vcgKDtree(at[border, , drop = FALSE], at, k = 1)$distance
    inner <- as.vector(near) > margin * radius
  }
  list(at = at, curved = curved, radius = radius, least = faint / radius,
       inner = inner & !is.na(curved$k1))
}

no_suggestion <- function(at, kind = character(), strength = numeric(), reason = character()) {
  data.frame(kind = kind, strength = strength, reason = reason, x = at[, 1], y = at[, 2],
             z = at[, 3])
}

#' Caps or cups: peaks of the lesser principal curvature
#'
#' @param width,tries As in [settled_peak()], `width` in radii: as [refine_landmarks()] has it;
#'   `near`: distance in radii of the vertices that take part.
#' @noRd
rounded_places <- function(kind, field, width = 0.75, near = 2.5) {
  value <- if (kind == "cap") -field$curved$k1 else field$curved$k2
  r <- field$radius
  rows <- local_maxima(field, value, r / 2)
  found <- lapply(rows, function(row) {
    own <- which(row_lengths(sweep(field$at, 2, field$at[row, ])) <= near * r & !is.na(value))
    peak <- settled_peak(list(at = field$at[own, , drop = FALSE], value = value[own],
                              normal = field$curved$normal[own, , drop = FALSE], dimensions = 2),
                         field$at[row, ], width * r)
    if (is.null(peak) || peak$value <= field$least ||
        sqrt(sum((peak$at - field$at[row, ])^2)) > r) return(NULL)
    said <- sprintf("%s: bends %s by at least %.3g in every direction", kind,
                    if (kind == "cap") "outwards" else "inwards", peak$value)
    no_suggestion(matrix(peak$at, 1), kind, peak$value, said)
  })
  do.call(rbind, found)
}

#' Vertices that no other within a distance exceeds
#' @noRd
local_maxima <- function(field, value, within) {
  tried <- which(field$inner & !is.na(value) & value > field$least)
  tried <- tried[order(-value[tried])]
  kept <- integer()
  while (length(tried)) {
    row <- tried[1]
    near <- row_lengths(sweep(field$at[tried, , drop = FALSE], 2, field$at[row, ])) <= within
    kept <- c(kept, row)
    tried <- tried[!near]
  }
  is_top <- function(row) {
    near <- row_lengths(sweep(field$at, 2, field$at[row, ])) <= within
    all(value[near] <= value[row], na.rm = TRUE)
  }
  kept[vapply(kept, is_top, NA)]
}

#' Ends and crossings of ridges, or of valleys
#' @noRd
line_places <- function(type, field, kinds, share) {
  if (!any(c("end", "crossing") %in% kinds)) return(NULL)
  strength <- strength_at(field$curved, type)
  rows <- which(field$inner & strength > field$least)
  if (!length(rows)) return(NULL)
  ring <- ring_strengths(field, rows, strength, type)
  above <- closed_ring(ring$value >= share * strength[rows])
  bins <- ncol(above)
  starts <- above & !above[, c(bins, seq_len(bins - 1)), drop = FALSE]
  arms <- rowSums(starts)
  rbind(
    if ("crossing" %in% kinds) {
      crossing_places(type, field, rows, ring, above, which(arms >= 3))
    },
    if ("end" %in% kinds) {
      end_places(type, field, rows, ring, strength[rows], share,
                 which(arms == 1 & rowSums(above) <= bins / 2))
    }
  )
}

#' The strongest strength in each direction of a ring about vertices
#'
#' Only ridges that leave the place count: one that passes by it does not.
#' @param rows Vertices.
#' @param ring Inner and outer radius of the ring, in radii of the curvature.
#' @param bins Number of directions.
#' @param facing Least cosine between the normals at the place and on its ring: the far side of a
#'   thin wall does not count.
#' @param leaving Least cosine between a ridge on the ring and the direction from the place.
#' @param most Numbers that are held at once.
#' @return List: `value` and `vertex`, rows x bins; a direction without a vertex has that of the
#'   next one that has.
#' @noRd
ring_strengths <- function(field, rows, strength, type, ring = c(1.25, 1.75), bins = 24,
                           facing = -0.5, leaving = 0.6, most = 2e6) {
  normal <- field$curved$normal
  lines <- field$curved[[if (type == "ridge") "direction1" else "direction2"]]
  # Both axes of the tangent plane: the principal directions
  axes <- field$curved[c("direction1", "direction2")]
  order <- order(field$curved$neighbours[rows])
  k <- pmin(ceiling(1.5 * ring[2]^2 * field$curved$neighbours[rows]) + 8, nrow(field$at))
  value <- matrix(NA_real_, length(rows), bins)
  vertex <- matrix(NA_integer_, length(rows), bins)
  while (length(order)) {
    own <- order[seq_len(max(1, sum(cumsum(k[order]) <= most)))]
    order <- order[-seq_along(own)]
    near <- Rvcg::vcgKDtree(field$at, field$at[rows[own], , drop = FALSE], k = max(k[own]))
    gap <- near$distance / field$radius
    on <- which(gap >= ring[1] & gap <= ring[2])
    i <- row(near$index)[on]
    j <- near$index[on]
    centre <- rows[own][i]
    step <- field$at[j, , drop = FALSE] - field$at[centre, , drop = FALSE]
    at <- function(axis) row_products(step, axis[centre, , drop = FALSE])
    bin <- floor((atan2(at(axes[[2]]), at(axes[[1]])) / (2 * pi) + 1) * bins) %% bins + 1
    faces <- row_products(normal[j, , drop = FALSE], normal[centre, , drop = FALSE]) > facing
    leaves <- abs(row_products(step, lines[j, , drop = FALSE])) >= leaving * row_lengths(step)
    seen <- which(!is.na(strength[j]) & faces)
    strength_out <- ifelse(leaves, strength[j], 0)
    # Of several vertices in one direction the last one assigned, the strongest, stays.
    seen <- seen[order(strength_out[seen])]
    value[cbind(own[i], bin)[seen, , drop = FALSE]] <- strength_out[seen]
    vertex[cbind(own[i], bin)[seen, , drop = FALSE]] <- j[seen]
  }
  filled_ring(value, vertex)
}

#' Directions without a vertex take the next one's, round the ring
#' @noRd
filled_ring <- function(value, vertex) {
  bins <- ncol(value)
  for (round in seq_len(bins)) {
    gone <- which(is.na(value))
    if (!length(gone)) break
    before <- c(bins, seq_len(bins - 1))
    value[gone] <- value[, before, drop = FALSE][gone]
    vertex[gone] <- vertex[, before, drop = FALSE][gone]
  }
  value[is.na(value)] <- 0
  list(value = value, vertex = vertex)
}

#' Directions above the limit without gaps narrower than 45 degrees: widened
#' by one direction on each side, then narrowed
#' @noRd
closed_ring <- function(above) {
  bins <- ncol(above)
  left <- c(bins, seq_len(bins - 1))
  right <- c(seq_len(bins - 1) + 1, 1)
  wide <- above | above[, left, drop = FALSE] | above[, right, drop = FALSE]
  wide & wide[, left, drop = FALSE] & wide[, right, drop = FALSE]
}

#' Crossings: the place nearest to the lines of all arms
#' @noRd
crossing_places <- function(type, field, rows, ring, above, which) {
  found <- lapply(which, function(i) {
    # Arms: runs of directions above the limit, each with its strongest vertex
    bins <- ncol(above)
    first <- match(FALSE, above[i, ])
    turn <- (first + seq_len(bins) - 1) %% bins + 1
    runs <- runs_of(above[i, turn])
    peak <- vapply(runs, function(run) turn[run[which.max(ring$value[i, turn[run]])]], 0)
    strength <- sort(ring$value[i, peak], decreasing = TRUE)
    at <- meeting_place(field, rows[i], ring$vertex[i, peak], type)
    said <- sprintf("crossing: %d %s meet, the third of strength %.3g", length(runs),
                    c(ridge = "ridges", valley = "valleys")[[type]], strength[3])
    no_suggestion(matrix(at, 1), "crossing", strength[3], said)
  })
  do.call(rbind, found)
}

#' The place nearest to the lines along the arms, by least squares; the vertex itself where it lies
#' farther off than a radius
#'
#' @param little Share of a line's own square that keeps nearly parallel arms near the vertex.
#' @noRd
meeting_place <- function(field, vertex, arms, type, little = 1e-3) {
  along <- field$curved[[if (type == "ridge") "direction1" else "direction2"]][arms, , drop = FALSE]
  own <- field$at[vertex, ]
  left <- little * diag(3)
  right <- numeric(3)
  for (i in seq_along(arms)) {
    across <- diag(3) - tcrossprod(along[i, ])
    left <- left + across
    right <- right + across %*% (field$at[arms[i], ] - own)
  }
  move <- drop(solve(left, right))
  if (sqrt(sum(move^2)) > field$radius) own else own + move
}

#' Ends: one arm, and the opposite half of the ring weaker by more than `share`
#' @noRd
end_places <- function(type, field, rows, ring, strength, share, which) {
  if (!length(which)) return(NULL)
  bins <- ncol(ring$value)
  ahead <- vapply(which, function(i) {
    arm <- which.max(ring$value[i, ])
    half <- (arm + bins / 2 + seq(-bins / 4, bins / 4) - 1) %% bins + 1
    max(ring$value[i, half])
  }, 0)
  fall <- strength[which] - ahead
  kept <- ahead < share * strength[which] & fall > field$least
  which <- which[kept]
  said <- sprintf("end: a %s of strength %.3g fades to %.3g", type, strength[which],
                  ahead[kept])
  no_suggestion(field$at[rows[which], , drop = FALSE], rep("end", length(which)), fall[kept], said)
}

#' The strongest places of each kind, none within a distance of a stronger one of its kind, nor of
#' one of a kind before
#' @noRd
sparse_places <- function(found, kinds, apart, n) {
  # Equal strengths: by what is said; never by the order of the vertices
  found <- found[order(match(found$kind, kinds), -signif(found$strength, 10), found$reason), ]
  at <- as.matrix(found[c("x", "y", "z")])
  open <- rep(TRUE, nrow(at))
  kept <- integer()
  while (any(open)) {
    row <- which(open)[1]
    kept <- c(kept, row)
    open[row_lengths(sweep(at, 2, at[row, ])) <= apart] <- FALSE
    open[row] <- FALSE
    if (sum(found$kind[kept] == found$kind[row]) == n) open[found$kind == found$kind[row]] <- FALSE
  }
  found[kept, ]
}

#' Suggestions on their mesh: all their columns are declared here
#'
#' @param found Data frame of [no_suggestion()].
#' @noRd
new_suggestions <- function(found, scan, curved, radius) {
  at <- as.matrix(found[c("x", "y", "z")])
  place <- surface_points(scan, at)
  near <- if (nrow(at)) {
    as.vector(Rvcg::vcgKDtree(t(scan$vb[1:3, , drop = FALSE]), at, k = 1)$index)
  }
  number <- stats::ave(seq_along(found$kind), found$kind, FUN = seq_along)
  table <- data.frame(
    landmark = paste0(found$kind, number, recycle0 = TRUE), kind = found$kind,
    strength = found$strength, shape_index = shape_index(curved)[near],
    curvedness = curvedness(curved)[near], reason = found$reason, place, row.names = NULL
  )
  structure(table, key = scan$key, id = scan$id, radius = radius,
            class = c("suggested_landmarks", "data.frame"))
}

#' @export
print.suggested_landmarks <- function(x, most = 40, ...) {
  check_method_dots(..., known = "most")
  check_most(most)
  needed <- c("landmark", "kind", "strength", "shape_index", "curvedness", "reason")
  if (!all(needed %in% names(x))) return(invisible(print(as.data.frame(x))))
  printed(x, {
    kinds <- table(factor(x$kind, c("cap", "cup", "crossing", "end")))
    cat(sprintf("<suggested_landmarks> %s at radius %g: %s\n", amount(nrow(x), "place"),
                attr(x, "radius"), paste(kinds, paste0(names(kinds), "s"), collapse = ", ")))
    rows <- utils::head(as.data.frame(x), most)
    if (nrow(rows)) {
      shown <- data.frame(landmark = rows$landmark, strength = signif(rows$strength, 3),
                          shape_index = round(rows$shape_index, 2),
                          reason = sub("^[a-z]+: ", "", rows$reason))
      print(shown, row.names = FALSE, right = FALSE)
    }
    if (nrow(x) > nrow(rows)) cat(sprintf("and %d more\n", nrow(x) - nrow(rows)))
    invisible(x)
  })
}

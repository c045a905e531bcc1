# Surfaces z(u, v) with a landmark whose place by shape is known, and schemes of that one
# definition.
graph_form <- function(z, half = 25) {
  list(x = quote(u), y = quote(v), z = z, u = c(-half, half), v = c(-half, half))
}

# A specimen of the graph, landmarks given by their u and v: rows of a matrix with names.
graph_specimen <- function(z, at, spacing = 0.8, half = 25) {
  made <- closed_form_mesh(graph_form(z, half), spacing)
  height <- eval(z, list(u = at[, 1], v = at[, 2]))
  specimen(made$mesh, cbind(at, height), outward = "keep", id = "graph")
}

# A scheme with one definition; `...` are its cells. `known`: names of the specimen's landmarks,
# pairs by their endings.
one_definition <- function(known, ...) {
  pairs <- side_pairs(known)
  ends <- setdiff(known, unlist(pairs))
  curve_scheme(data.frame(landmark = known),
               data.frame(curve = "line", from = ends[1], to = ends[2], kind = "plane", n = 2),
               pairs = if (nrow(pairs)) data.frame(level = "landmarks", pairs), name = "graph",
               definitions = data.frame(...))
}

place_of <- function(specimen) unlist(specimen$refinement[c("x", "y", "z")])

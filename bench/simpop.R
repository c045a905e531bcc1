# Curves of the face across 23 simulated faces in dense correspondence: as the scheme has them, and
# in other ways.
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/simpop.R
#
# All faces have the same 7,160 vertices and triangles, so that a point of a face, given by triangle
# and weights, is a place of the mean mesh (mean of the faces after rotation and shift). The spread
# of a curve's points: RMS distance (mm) of these places from their mean over the faces, along and
# across the mean curve, ends left out. Every curve is found as the scheme has it; as the shortest
# cut, without constraints; and as a ridge and a valley, with those of its row. Curves from the ear
# are cut at the smallest share that any face allows. Strength: mean along the curve of the
# principal curvature at the row's radius, the same estimates for all ways. "pays": where curvature
# is used, the spread across is no larger than that of the shortest cut, or at most 0.6 mm with at
# least 1.2 times the strength.

library(crestline)

folder <- file.path(Sys.getenv("CRESTLINE_SHARED"), "simpop")
pays_below <- 0.6
pays_strength <- 1.2
scheme <- face_scheme()
placed <- read.csv(file.path(folder, "landmarks.csv"))
faces <- lapply(unique(placed$id), function(id) {
  rows <- placed[placed$id == id, ]
  landmarks <- as.matrix(data.frame(rows[c("x", "y", "z")], row.names = rows$landmark))
  suppressWarnings(read_specimen(file.path(folder, paste0(id, ".ply")), landmarks, id = id))
})
curved <- lapply(faces, function(face) {
  lapply(c("5" = 5, "10" = 10), function(r) curvature(face, r, ridge_settings()$order))
})

# The faces' mean after rotation and shift, n x 3.
mean_vertices <- function(faces, rounds = 5) {
  xyz <- lapply(faces, function(face) scale(t(face$mesh$vb[1:3, ]), scale = FALSE))
  centre <- xyz[[1]]
  for (i in seq_len(rounds)) {
    turned <- lapply(xyz, function(x) {
      s <- svd(crossprod(x, centre))
      x %*% s$u %*% diag(c(1, 1, sign(det(tcrossprod(s$u, s$v))))) %*% t(s$v)
    })
    centre <- Reduce(`+`, turned) / length(turned)
  }
  centre
}

carried <- function(points, centre, it) {
  corner <- function(i, w) w * centre[it[i, points$face], , drop = FALSE]
  corner(1, points$w1) + corner(2, points$w2) + corner(3, points$w3)
}

spread <- function(places) {
  at <- simplify2array(places)
  middle <- apply(at, 1:2, mean)
  n <- nrow(middle)
  if (n < 3) return(c(along = 0, across = 0))  # both are landmarks
  tangent <- middle[c(2:n, n), ] - middle[c(1, 1:(n - 1)), ]
  tangent <- tangent / sqrt(rowSums(tangent^2))
  inner <- 2:(n - 1)
  along <- apply(at, 3, function(x) rowSums((x - middle) * tangent))[inner, ]
  total <- apply(at, 3, function(x) rowSums((x - middle)^2))[inner, ]
  sqrt(c(along = mean(along^2), across = mean(total - along^2)))
}

strength_along <- function(path, curved, it, type) {
  value <- crestline:::strength_at(curved, type)
  value[is.na(value)] <- 0
  at <- path$w1 * value[it[1, path$face]] + path$w2 * value[it[2, path$face]] +
    path$w3 * value[it[3, path$face]]
  weighted.mean((at[-1] + at[-length(at)]) / 2, diff(path$s))
}

# The scheme's curves alone, all found in one way.
in_way <- function(way) {
  curves <- scheme$curves
  free <- way == "plane" | curves$kind == "plane"
  if (way != "scheme") {
    curves$kind <- way
    curves$angle_limit[free] <- NA
  }
  curve_scheme(scheme$landmarks, curves,
               pairs = scheme$pairs[scheme$pairs$level != "surface", ], name = way)
}

fit_all <- function(scheme, cut_scale, error = FALSE) {
  lapply(faces, fit_shape, scheme, ridge_settings(error = error), cut_scale = cut_scale,
         progress = FALSE)
}

measured <- function(shapes, way) {
  each <- lapply(seq_len(nrow(scheme$curves)), function(i) {
    name <- scheme$curves$curve[i]
    fitted <- which(vapply(shapes, function(shape) shape$status$ok[shape$status$part == name], NA))
    it <- faces[[1]]$mesh$it
    places <- lapply(shapes[fitted], function(shape) {
      carried(shape$points[shape$points$level == "curves" & shape$points$part == name, ], centre,
              it)
    })
    strength <- function(type) {
      radius <- as.character(scheme$curves$radius[i])
      mean(vapply(fitted, function(k)
        strength_along(shapes[[k]]$paths[[name]], curved[[k]][[radius]], it, type), 0))
    }
    determined <- vapply(shapes[fitted],
                         function(shape) shape$checks$determined[shape$checks$part == name], NA)
    data.frame(curve = name, way = way, fitted = length(fitted), t(spread(places)),
               ridge = strength("ridge"), valley = strength("valley"),
               undetermined = sum(!determined, na.rm = TRUE))
  })
  do.call(rbind, each)
}

centre <- mean_vertices(faces)
whole <- fit_all(scheme, 1, error = TRUE)
cut_scale <- min(vapply(whole, function(shape) min(shape$checks$cut, na.rm = TRUE), 0))
cat(sprintf("%d faces; curves from the ear cut at %.3g of the scheme's shares\n",
            length(faces), cut_scale))
ways <- c("scheme", "plane", "ridge", "valley")
found <- lapply(stats::setNames(ways, ways),
                function(way) measured(fit_all(in_way(way), cut_scale, way == "scheme"), way))

kind <- scheme$curves$kind
# Strength of each way over that of the shortest cut, of the given type.
gain <- function(way, type) {
  of <- function(table) table[cbind(seq_along(type), match(type, names(table)))]
  as.numeric(of(found[[way]])) / as.numeric(of(found$plane))
}
used <- ifelse(kind == "plane", NA, gain("scheme", ifelse(kind == "plane", "ridge", kind)))
across <- found$scheme$across
table <- data.frame(
  curve = scheme$curves$curve, kind, fitted = found$scheme$fitted,
  along = found$scheme$along, across,
  strength = ifelse(kind == "valley", found$scheme$valley,
                    ifelse(kind == "ridge", found$scheme$ridge, NA)),
  cut_along = found$plane$along, cut_across = found$plane$across, gain = used,
  undetermined = found$scheme$undetermined, ridge_across = found$ridge$across,
  ridge_gain = gain("ridge", rep("ridge", length(kind))),
  ridge_undetermined = found$ridge$undetermined, valley_across = found$valley$across,
  valley_gain = gain("valley", rep("valley", length(kind))),
  valley_undetermined = found$valley$undetermined,
  pays = ifelse(kind == "plane", "", across <= found$plane$across |
                                     (across <= pays_below & used >= pays_strength))
)
gains <- grep("gain", names(table))
table[gains] <- lapply(table[gains], pmin, 99)  # the cut has none of that curvature
numbers <- vapply(table, is.double, NA)
table[numbers] <- lapply(table[numbers], round, 2)
options(width = 250)
print(table, row.names = FALSE)
cat(sprintf("fitted on all faces: %d of %d curves\n", sum(table$fitted == length(faces)),
            nrow(table)))

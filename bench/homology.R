# Are homologised points nearer to the same place than those of a warp?
#
#   CRESTLINE_SHARED=../shared/data Rscript bench/homology.R FOLDER [case ...]
#
# Cases: simpop simpop-noise simulated simulated-noise ict ict-moved ict-found simpop-found. Shapes
# and results are kept in FOLDER, so that a run that was stopped goes on. Every point is carried to
# the mean face by the dense correspondence of the population; the tables have its RMS distance from
# its mean over faces, mm. "warp" is the rival as its users run it: the thin-plate spline through
# the 23 landmarks from the same mean template, then the closest point of the mesh (Morpho, Rvcg).
# "held": curve points stay on their curves, the default before. "free": slide_settings().

library(crestline)

options(rgl.useNULL = TRUE, width = 220)
inner <- function(name) getFromNamespace(name, "crestline")
shared <- Sys.getenv("CRESTLINE_SHARED")
all_cases <- c("simpop", "simpop-noise", "simulated", "simulated-noise", "ict", "ict-moved",
               "ict-found", "simpop-found")
folder <- commandArgs(TRUE)[1]
wanted <- commandArgs(TRUE)[-1]
if (!length(wanted)) wanted <- all_cases

kept <- function(name, make) {
  file <- file.path(folder, paste0(name, ".rds"))
  if (!file.exists(file)) saveRDS(make(), file, compress = FALSE)
  readRDS(file)
}

landmark_tables <- function(folder) {
  table <- read.csv(file.path(shared, folder, "landmarks.csv"))
  lapply(split(table, table$id),
         function(rows) `rownames<-`(as.matrix(rows[c("x", "y", "z")]), rows$landmark))
}

fitted <- function(faces) {
  lapply(faces, function(face)
    suppressWarnings(fit_shape(face, face_scheme(), progress = FALSE,
                               measuring = shape_settings(cut_scale = 0.82))))
}

# Noise along the normals, and landmarks moved (RMS distance) and put on the mesh.
worsened <- function(mesh, landmarks, id, noise, moved) {
  mesh <- Rvcg::vcgUpdateNormals(mesh, silent = TRUE)
  mesh$vb[1:3, ] <- mesh$vb[1:3, ] + mesh$normals[1:3, ] *
    rep(rnorm(ncol(mesh$vb), 0, noise), each = 3)
  mesh$normals <- NULL
  suppressWarnings(specimen(mesh,
                            landmarks + rnorm(length(landmarks), 0, moved / sqrt(3)), id = id))
}

found_on <- function(mesh, id) suppressWarnings(find_landmarks(specimen(mesh, id = id)))

# Faces on which find_landmarks() itself doubts no more than half of the landmarks that it found.
trusted <- function(shapes) {
  vapply(shapes, function(shape) {
    placing <- shape$placing
    is.null(placing) ||
      length(inner("placing_doubt")(placing)$names) <= sum(placing$state == "found") / 2
  }, NA)
}

read_mesh <- function(folder, id) {
  Rvcg::vcgImport(file.path(shared, folder, paste0(id, ".ply")), silent = TRUE, clean = FALSE,
                  readcolor = FALSE)
}

population <- function(name) {
  noisy <- grepl("noise", name)
  if (grepl("simpop", name)) {
    landmarks <- landmark_tables("simpop")
    set.seed(1)
    meshes <- lapply(names(landmarks), read_mesh, folder = "simpop")
    faces <- if (name == "simpop-found") Map(found_on, meshes, names(landmarks)) else
      Map(worsened, meshes, landmarks, names(landmarks), 0.2 * noisy, 1 * noisy)
    dense <- lapply(meshes, function(mesh) t(mesh$vb[1:3, ]))
    return(list(shapes = fitted(faces), dense = dense,
                it = lapply(faces, function(face) face$mesh$it)))
  }
  if (grepl("simulated", name)) {
    scan <- scan_settings(noise = if (noisy) 0.2 else 0.05, landmark_error = if (noisy) 0.6 else 0)
    made <- suppressWarnings(simulate_faces(12, effect = 0, scan = scan, seed = 7,
                                            progress = FALSE))
    return(list(shapes = fitted(made$specimens), places = made$vertices,
                it = lapply(made$specimens, function(face) face$mesh$it)))
  }
  ict(name)
}

ict <- function(name) {
  landmarks <- landmark_tables("ict")
  ids <- sprintf("ict_%02d", seq(1, 19, 2))
  top <- readRDS(file.path(shared, "ict", "triangles.rds"))
  # find_landmarks() fails on this face (../shared/data/ict/README.md).
  if (name == "ict-found") ids <- setdiff(ids, "ict_11")
  set.seed(5)
  faces <- lapply(stats::setNames(nm = ids), function(id) {
    mesh <- read_mesh("ict", id)
    if (name == "ict-found") return(found_on(mesh, id))
    own <- landmarks[[id]]
    if (name == "ict-moved") own[] <- own + rnorm(length(own), 0, 2 / sqrt(3))
    on <- locate(mesh, own)
    suppressWarnings(specimen(mesh, `rownames<-`(as.matrix(on[c("x", "y", "z")]), rownames(own)),
                              id = id))
  })
  dense <- lapply(ids, function(id) readRDS(file.path(shared, "ict", paste0(id, "_dense.rds"))))
  list(shapes = fitted(faces), dense = dense, it = t(top), dense_mesh = TRUE)
}

# ---- points, and where they are carried to ----

# Matrix by place: x, y, z, face, w1, w2, w3.
store_of <- function(shape) {
  first <- !duplicated(shape$scheme$points$place)
  `rownames<-`(as.matrix(shape$points[first, c("x", "y", "z", "face", "w1", "w2", "w3")]),
               shape$scheme$points$place[first])
}

warp_store <- function(shape, template) {
  store <- store_of(shape)
  from <- coords(template, "landmarks")
  to <- coords(shape, "landmarks")
  both <- !is.na(from[, 1]) & !is.na(to[, 1])
  at <- rownames(store)[!is.na(store[, 1])]
  at <- at[!grepl("^landmarks", at)]
  image <- Morpho::tps3d(inner("places_of")(template)[at, ], from[both, ], to[both, ], threads = 1)
  on <- Rvcg::vcgClostKD(image, shape$specimen$mesh, barycentric = TRUE, threads = 1)
  store[at, ] <- cbind(t(on$vb[1:3, ]), on$faceptr, t(on$barycoords))
  store
}

corners_at <- function(it, face, weight, at) {
  weight[, 1] * at[it[1, face], ] + weight[, 2] * at[it[2, face], ] +
    weight[, 3] * at[it[3, face], ]
}

carried <- function(case, stores) {
  out <- vapply(seq_along(stores), function(i) {
    store <- stores[[i]]
    on <- !is.na(store[, 1])
    to <- if (is.null(case$places)) case$mean else case$places[[i]]
    if (isTRUE(case$dense_mesh)) {
      own <- structure(list(vb = rbind(t(case$dense[[i]]), 1), it = case$it), class = "mesh3d")
      near <- Rvcg::vcgClostKD(store[on, 1:3], own, barycentric = TRUE, threads = 1)
      store[on, 1:3] <- corners_at(case$it, near$faceptr, t(near$barycoords), to)
    } else {
      store[on, 1:3] <- corners_at(case$it[[i]], store[on, 4], store[on, 5:7, drop = FALSE], to)
    }
    store[, 1:3]
  }, stores[[1]][, 1:3])
  dimnames(out) <- list(rownames(stores[[1]]), NULL, NULL)
  out
}

# ---- measures ----

curve_points <- function(scheme) {
  curves <- with(scheme$curves, curve[n > 2])
  lapply(stats::setNames(nm = curves),
         function(name) with(scheme$points, place[level == "curves" & part == name]))
}

curve_spread <- function(at, scheme) {
  do.call(rbind, Map(function(place, name) {
    n <- length(place)
    middle <- apply(at[place, , ], 1:2, mean, na.rm = TRUE)
    tangent <- middle[c(2:n, n), ] - middle[c(1, 1:(n - 1)), ]
    tangent <- tangent / sqrt(rowSums(tangent^2))
    off <- sweep(at[place, , ], 1:2, middle)[2:(n - 1), , , drop = FALSE]
    along <- apply(off, 3, function(d) rowSums(d * tangent[2:(n - 1), , drop = FALSE]))
    total <- apply(off, 3, function(d) rowSums(d^2))
    data.frame(curve = name, points = n - 2, along = sqrt(mean(along^2, na.rm = TRUE)),
               across = sqrt(mean(pmax(total - along^2, 0), na.rm = TRUE)))
  }, curve_points(scheme), names(curve_points(scheme))))
}

pooled <- function(x, weight) sqrt(sum(x^2 * weight) / sum(weight))

spread_row <- function(at, scheme) {
  by <- curve_spread(at, scheme)
  total <- sqrt(by$along^2 + by$across^2)
  row <- match(by$curve, scheme$curves$curve)
  cut <- !is.na(scheme$curves$cut_share[row])
  plane <- scheme$curves$kind[row] == "plane"
  of <- function(k) pooled(total[k], by$points[k])
  face_parts <- grepl("lip|philtr|mentolab|socket", by$curve)
  free <- setdiff(unique(scheme$points$place), inner("bound_places")(scheme))
  off <- sweep(at[free, , ], 1:2, apply(at[free, , ], 1:2, mean, na.rm = TRUE))
  data.frame(along = pooled(by$along, by$points), across = pooled(by$across, by$points),
             curves = of(TRUE), ridges = of(!plane), cuts = of(plane & !cut),
             to_ear = of(plane & cut), brow = of(grepl("brow", by$curve)),
             sockets = of(grepl("socket", by$curve)),
             lips = of(!plane & grepl("lip|philtr", by$curve)),
             bridge = of(grepl("nasal bridge", by$curve)), no_mouth = of(!face_parts),
             no_brow = of(!grepl("brow", by$curve)),
             surface = sqrt(mean(apply(off, 3, function(d) rowSums(d^2)), na.rm = TRUE)))
}

# Least step of neighbours along the template's direction, in the template's steps; steps back;
# triangles turned over.
order_of <- function(stores, template, scheme) {
  to <- inner("places_of")(template)
  it <- inner("model_triangles")(scheme, TRUE)
  normals <- function(x) {
    inner("cross_rows")(x[it[2, ], ] - x[it[1, ], ], x[it[3, ], ] - x[it[1, ], ])
  }
  wanted <- normals(to)
  each <- vapply(stores, function(store) {
    x <- inner("laid_onto")(store[, 1:3], to[rownames(store), ], TRUE)
    step <- unlist(lapply(curve_points(scheme), function(place) {
      aim <- diff(to[place, ])
      rowSums(aim * diff(x[place, ])) / rowSums(aim^2)
    }))
    turned <- rowSums(normals(x[rownames(to), ]) * wanted)
    c(min(step, na.rm = TRUE), sum(step <= 0, na.rm = TRUE), sum(turned <= 0, na.rm = TRUE),
      sum(!is.na(turned)))
  }, numeric(4))
  data.frame(least_step = min(each[1, ]), back = sum(each[2, ]), folds = sum(each[3, ]),
             triangles = sum(each[4, ]))
}

# RMS distance of every curve from its median place, curves x faces.
off_median <- function(at, scheme) {
  t(vapply(curve_points(scheme), function(place) {
    place <- place[-c(1, length(place))]
    off <- sweep(at[place, , , drop = FALSE], 1:2,
                 apply(at[place, , , drop = FALSE], 1:2, median, na.rm = TRUE))
    apply(off, 3, function(d) sqrt(mean(rowSums(matrix(d, ncol = 3)^2), na.rm = TRUE)))
  }, numeric(dim(at)[3])))
}

procrustes_distances <- function(at, scale) {
  whole <- apply(!is.na(at), 1, all)
  utils::capture.output(laid <- suppressMessages(Morpho::procSym(at[whole, , ], CSinit = scale,
                                                                 scale = scale, reflect = FALSE)))
  as.vector(dist(t(apply(laid$rotated, 3, c))))
}

# Points of every face where the mean face has them, by the dense correspondence: what points would
# be that are homologous without error. Places x 3 x faces.
perfect_places <- function(case, middle) {
  it <- if (isTRUE(case$dense_mesh)) case$it else case$it[[1]]
  on <- structure(list(vb = rbind(t(case$mean), 1), it = it), class = "mesh3d")
  near <- Rvcg::vcgClostKD(middle, on, barycentric = TRUE, threads = 1)
  vapply(case$dense, function(x) corners_at(it, near$faceptr, t(near$barycoords), x), middle)
}

# Correlation of distances between faces, in shape and in shape and size, with those of the dense
# mesh about the points; and, in shape, with those of the same points without error (`own`).
distance_rows <- function(case, stores, carried, scheme) {
  if (is.null(case$dense)) return(NULL)
  middle <- apply(carried, 1:2, mean, na.rm = TRUE)
  near <- which(Rvcg::vcgKDtree(middle[complete.cases(middle), ], case$mean, k = 1,
                                threads = 1)$distance[, 1] < 8)
  cell <- apply(round(case$mean[near, ] / 4), 1, paste, collapse = " ")
  dense <- vapply(case$dense, function(x) x[near[!duplicated(cell)], ],
                  case$mean[near[!duplicated(cell)], ])
  truth <- list(shape = procrustes_distances(dense, TRUE),
                form = procrustes_distances(dense, FALSE))
  apart <- function(store, place, scale) {
    x <- vapply(store, function(x) x[place, 1:3], store[[1]][place, 1:3])
    procrustes_distances(x, scale)
  }
  columns <- lapply(c(curves = "curves", surface = "surface"), function(level) {
    place <- unique(scheme$points$place[scheme$points$level == level])
    place <- place[complete.cases(middle[place, ])]
    own <- procrustes_distances(perfect_places(case, middle[place, ]), TRUE)
    t(vapply(stores, function(store) {
      shape <- apart(store, place, TRUE)
      c(shape = cor(shape, truth$shape), form = cor(apart(store, place, FALSE), truth$form),
        own = cor(shape, own))
    }, numeric(3)))
  })
  data.frame(what = names(stores), columns)
}

# What quality() says of curves that are off, before (held) and by their offset.
flag_rows <- function(off, shapes, scheme) {
  graded <- lapply(shapes, function(shape) {
    table <- as.data.frame(quality(shape))
    other <- as.data.frame(quality(shape, quality_limits(offset = c(Inf, Inf))))
    row <- match(rownames(off), ifelse(table$level == "curves", table$part, NA))
    list(amber = table$grade[row] > "green", else_amber = other$grade[row] > "green",
         offset = shape$checks$offset[match(rownames(off),
                                            ifelse(shape$checks$level == "curves",
                                                   shape$checks$part, NA))])
  })
  of <- function(name) vapply(graded, `[[`, graded[[1]][[name]], name)
  plane <- scheme$curves$kind[match(rownames(off), scheme$curves$curve)] == "plane"
  offset <- of("offset")
  other <- of("else_amber")
  do.call(rbind, lapply(c(ridges = FALSE, cuts = TRUE), function(cuts) {
    k <- plane == cuts
    wrong <- off[k, ] > 3
    flagged <- offset[k, ] > quality_limits()$offset[1]
    green <- !other[k, ]
    data.frame(off = sum(wrong, na.rm = TRUE), off_flagged = sum(wrong & flagged, na.rm = TRUE),
               off_green = sum(wrong & green, na.rm = TRUE),
               off_green_flagged = sum(wrong & green & flagged, na.rm = TRUE),
               right_green = sum(!wrong & green, na.rm = TRUE),
               right_green_flagged = sum(!wrong & green & flagged, na.rm = TRUE))
  }))
}

# ---- a case ----

measured_case <- function(name) {
  case <- kept(paste0("shapes-", name), function() population(name))
  scheme <- case$shapes[[1]]$scheme
  if (!is.null(case$dense)) case$mean <- inner("procrustes_mean")(case$dense, case$dense[[1]])
  seconds <- numeric()
  run <- function(how) {
    time <-
      system.time(sample <- suppressWarnings(homologise(case$shapes,
                                                        settings = slide_settings(curves = how),
                                                        progress = FALSE)))
    seconds[how] <<- time[["user.self"]] / length(case$shapes)
    sample
  }
  held <- run("held")
  free <- run("free")
  stores <- list(measured = lapply(case$shapes, store_of),
                 warp = lapply(case$shapes, warp_store, free$template),
                 held = lapply(held$shapes, store_of), free = lapply(free$shapes, store_of))
  at <- lapply(stores, function(store) carried(case, store))
  sure <- trusted(case$shapes)
  spread_over <- function(faces) {
    do.call(rbind, lapply(at, function(one) spread_row(one[, , faces], scheme)))
  }
  share_of <- function(spread) sweep(as.matrix(spread), 2, as.matrix(spread)["warp", ], `/`)[3:4, ]
  spread <- spread_over(TRUE)
  off <- lapply(at, off_median, scheme)
  plane <- scheme$curves$kind[match(rownames(off[[1]]), scheme$curves$curve)] == "plane"
  offset <- unlist(lapply(free$shapes, function(shape) {
    ridge <- with(scheme$curves, curve[kind != "plane"])
    own <- shape$points$level == "curves" & shape$points$part %in% ridge
    shape$points$offset[own]
  }))
  list(name = name, spread = spread,
       share = share_of(spread), trusted = sum(sure),
       trusted_share = if (!all(sure)) share_of(spread_over(sure)),
       order = do.call(rbind, lapply(stores[-1], order_of, free$template, scheme)),
       off = vapply(off,
                    function(x)
                      c(all = sum(x > 3, na.rm = TRUE),
                        ridges = sum(x[!plane, ] > 3, na.rm = TRUE)), numeric(2)),
       only_free = which(off$free > 3 & off$warp <= 3, arr.ind = TRUE), off_values = off,
       offset_rms = sqrt(mean(offset^2, na.rm = TRUE)),
       distances = distance_rows(case, stores[-1], at$warp, scheme),
       flags = flag_rows(off$measured, free$shapes, scheme), by = lapply(at, curve_spread, scheme),
       seconds = seconds, trace = vapply(free$shapes, function(shape) {
         row <- shape$sliding[shape$sliding$part == "joint", ]
         c(row$sweeps, row$converged)
       }, numeric(2)))
}

report_case <- function(name) {
  found <- measured_case(name)
  saveRDS(found, file.path(folder, paste0("result-", name, ".rds")))
  cat("\n==", name, "\n")
  print(round(found$spread, 3))
  print(round(found$share, 3))
  if (!is.null(found$trusted_share)) {
    cat("the", found$trusted, "faces with landmarks that find_landmarks() does not doubt:\n")
    print(round(found$trusted_share, 3))
  }
  print(found$order)
  cat("curves more than 3 mm off their median place; off where the warp's is not:\n")
  print(found$off)
  print(found$only_free)
  cat(sprintf(paste("ridge points off their curve %.2f mm RMS; user seconds a face: held %.2f,",
                    "free %.2f; sweeps %s, %d of %d converged\n"),
              found$offset_rms, found$seconds[["held"]], found$seconds[["free"]],
              paste(range(found$trace[1, ]), collapse = " to "), sum(found$trace[2, ]),
              ncol(found$trace)))
  print(found$distances, digits = 3)
  print(found$flags)
}

# bench/homology-more.R and bench/homology-constants.R take the functions above.
if (sys.nframe() == 0) for (name in wanted) report_case(name)

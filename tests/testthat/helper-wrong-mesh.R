# What is done with meshes that are not the ones they should be: the calls, the wrong meshes, and
# objects that were damaged.

# A ball with left and right, all that is measured on it, and a sample of two.
own_mesh_case <- function() {
  specimen <- stretched_ball()
  at <- specimen$landmarks
  shape <- paired_shape()
  path <- plane_path(specimen, "lowL", "highR")
  list(specimen = specimen, shape = shape, template = symmetrise(shape), path = path,
       coordinates = path_coordinates(specimen, path, width = 10),
       curvature = curvature(specimen, 15, "quadratic"),
       curve = ridge_curve(specimen, "lowL", "highR", "plane", n = 5),
       row = as.data.frame(path)[3, ],
       sample = homologise(list(shape, paired_shape(c(1.2, 1, 1.1), "wide")), rounds = 2,
                           progress = FALSE) |>
         suppressWarnings(), places = at[1:3, ])
}

# The same object with changes behind the back of its methods.
tampered <- function(x, change) {
  fields <- change(unclass(x))
  class(fields) <- class(x)
  fields
}

# Specimens that are not that of the case: `other` ones are sound, the rest are damaged.
wrong_specimens <- function(case) {
  own <- case$specimen
  again <- function(mesh, id = "ball", landmarks = own$landmarks) {
    specimen(mesh, landmarks, id, outward = "keep", tolerance = 0.05)
  }
  in_mesh <- function(change) tampered(own, function(x) {
    x$mesh <- change(x$mesh)
    x
  })
  in_geometry <- function(change) tampered(own, function(x) {
    x$geometry <- change(x$geometry)
    x
  })
  reordered <- own$mesh
  reordered$it <- reordered$it[, rev(seq_len(ncol(reordered$it)))]
  turned <- own$mesh
  turned$it <- turned$it[c(2, 3, 1), ]
  moved <- own$mesh
  moved$vb[1, ] <- moved$vb[1, ] + 100
  cut <- own$mesh
  cut$it <- cut$it[, -ncol(cut$it)]
  c(
    list(`other: wide` = stretched_ball(c(1.2, 1, 1.1), "wide"),
         `other: wide, same id` = stretched_ball(c(1.2, 1, 1.1)),
         `other: reordered` = again(reordered), `other: corners turned` = again(turned),
         `other: cut` = again(cut),
         `other: moved` = again(moved, landmarks = own$landmarks + rep(c(100, 0, 0), each = 6)),
         `mesh exchanged` = in_mesh(function(mesh) stretched_ball(c(1.2, 1, 1.1))$mesh),
         `mesh reordered` = in_mesh(function(mesh) reordered)),
    lapply(damaged_meshes(own$mesh), function(mesh) in_mesh(function(own) mesh)),
    list(`no normals` = in_mesh(function(mesh) within_list(mesh, normals = NULL)),
         `few normals` = in_mesh(function(mesh) within_list(mesh, normals = mesh$normals[, 1:3])),
         `twins gone` = in_geometry(function(geometry) within_list(geometry, twin = NULL)),
         `twins out of range` = in_geometry(function(geometry)
           within_list(geometry, twin = geometry$twin + 1000000L)),
         `twins turned` = in_geometry(function(geometry)
           within_list(geometry, twin = geometry$twin[, rev(seq_len(ncol(geometry$twin)))])),
         `twins too few` = in_geometry(function(geometry)
           within_list(geometry, twin = geometry$twin[, 1:5])),
         `pieces too few` = in_geometry(function(geometry) within_list(geometry, piece = 1L)),
         `places out of range` = in_geometry(function(geometry) {
           geometry$located$face <- 1000000000L
           geometry
         }),
         `geometry gone` = tampered(own, function(x) within_list(x, geometry = NULL)),
         `mesh gone` = tampered(own, function(x) within_list(x, mesh = NULL)),
         `landmarks as text` = tampered(own, function(x) within_list(x, landmarks = "lowL")))
  )
}

within_list <- function(x, ...) {
  change <- list(...)
  x[names(change)] <- change
  x
}

# Meshes that no kernel may walk on.
damaged_meshes <- function(mesh) {
  n <- ncol(mesh$vb)
  put <- function(name, at, value) {
    mesh[[name]][at] <- value
    mesh
  }
  list(
    `index far out` = put("it", 1, 1000000000L), `index one out` = put("it", 7, n + 1L),
    `index negative` = put("it", 2, -5L), `index zero` = put("it", 4, 0L),
    `counted from 0` = within_list(mesh, it = mesh$it - 1L), `index NA` = put("it", 5, NA),
    `index not whole` = put("it", 6, 1.5), `index infinite` = put("it", 6, Inf),
    `index huge` = put("it", 6, 1e300), `faces in rows` = within_list(mesh, it = t(mesh$it)),
    `faces as text` = within_list(mesh, it = array("1", dim(mesh$it))),
    `four corners` = within_list(mesh, it = rbind(mesh$it, mesh$it[1, ])),
    `no faces` = within_list(mesh, it = NULL), `co-ordinate NaN` = put("vb", 5, NaN),
    `co-ordinate NA` = put("vb", 5, NA), `co-ordinate infinite` = put("vb", 9, -Inf),
    `co-ordinate absurd` = put("vb", 1, 1e300), `fourth row 0` = put("vb", 8, 0),
    `vertices in rows` = within_list(mesh, vb = t(mesh$vb)),
    `two rows` = within_list(mesh, vb = mesh$vb[1:2, ]),
    `vertices without dim` = within_list(mesh, vb = as.vector(mesh$vb)),
    `vertices as text` = within_list(mesh, vb = array("1", dim(mesh$vb))),
    `too few vertices` = within_list(mesh, vb = mesh$vb[, 1:10]),
    `no vertices` = within_list(mesh, vb = NULL), `a list` = unclass(mesh),
    `a number` = structure(1, class = "mesh3d")
  )
}

temporary <- function(extension) tempfile(fileext = extension)

# Every exported function that takes something of a mesh, and a specimen: called with the case's
# things and any specimen.
own_mesh_calls <- function() {
  list(
    slide = function(case, one) slide(case$shape, case$template, specimen = one),
    `slide, specimen kept` = function(case, one)
      slide(tampered(case$shape, function(x) within_list(x, specimen = one)), case$template),
    homologise = function(case, one) {
      homologise(list(case$shape), case$template, specimens = list(ball = one), rounds = 0,
                 progress = FALSE)
    },
    `homologise, by function` = function(case, one) {
      homologise(list(case$shape), case$template, specimens = function(id) one, rounds = 0,
                 progress = FALSE)
    },
    `homologise, specimen kept` = function(case, one) {
      shape <- tampered(case$shape, function(x) within_list(x, specimen = one))
      homologise(list(shape), case$template, rounds = 0, progress = FALSE)
    },
    `slide, of a sample` = function(case, one)
      slide(case$sample$shapes$ball, case$sample$template, specimen = one),
    shape_mesh = function(case, one) shape_mesh(case$shape, specimen = one, dense = 2),
    `shape_mesh, of a sample` = function(case, one)
      shape_mesh(case$sample$shapes$ball, specimen = one, dense = 2),
    patch_mesh = function(case, one) patch_mesh(case$shape, one, "cheek left", 5, 5),
    surface_faults = function(case, one) surface_faults(case$shape, one),
    quality_report = function(case, one)
      quality_report(case$shape, temporary(".html"), one, size = c(300, 150)),
    write_slicer = function(case, one) write_slicer(case$shape, tempfile("slicer"), one),
    path_coordinates = function(case, one) path_coordinates(one, case$path, 10),
    lift = function(case, one)
      lift(one, case$coordinates, case$path, c(0, attr(case$path, "length")), c(0, 0)),
    `plane_path, from a row` = function(case, one) plane_path(one, case$row, "highL"),
    `plane_path, to a row` = function(case, one) plane_path(one, "highL", case$row),
    `reference_path, from a row` = function(case, one)
      reference_path(one, case$row, "highL", "plane"),
    `ridge_curve, from a row` = function(case, one)
      ridge_curve(one, case$row, "highL", "plane", n = 5),
    `ridge_curve, away from a row` = function(case, one) {
      ridge_curve(one, "lowL", "highR", "ridge", 15, 10, 5,
                  keep_away = keep_away(case$row, "highL", 0.01), reach = 1)
    },
    `reference_path, curvature` = function(case, one)
      reference_path(one, "lowL", "highR", "ridge", case$curvature),
    `ridge_curve, curvature` = function(case, one)
      ridge_curve(one, "lowL", "highR", "ridge", case$curvature, 10, 5),
    `refine_landmarks, curvature` = function(case, one) {
      refine_landmarks(one, case$defined, curvature = function(radius) case$curvature)
    },
    `plot.specimen, curvature` = function(case, one)
      plot(one, "shape index", curvature = case$curvature, engine = "picture"),
    plot.curve = function(case, one) plot(case$curve, one, "plain", engine = "picture"),
    plot_curves = function(case, one)
      plot_curves(list(a = case$curve), one, "plain", engine = "picture"),
    plot.shape = function(case, one) plot(case$shape, one, surface = "plain", engine = "picture"),
    `write_page, curves` = function(case, one)
      write_page(one, temporary(".html"), list(a = case$curve), surface = "plain",
                 selfcontained = FALSE),
    `write_page, shape` = function(case, one)
      write_page(one, temporary(".html"), case$shape, surface = "plain", selfcontained = FALSE),
    `fit_shape, curves` = function(case, one) {
      fit_shape(one, case$shape$scheme, ridge_settings(error = FALSE),
                curves = list(across = case$across), progress = FALSE)
    }
  )
}

# Every exported function that takes a specimen, or a bare mesh in its place.
any_mesh_calls <- function() {
  list(
    curvature = function(case, one) curvature(one, 15, vertices = 1:20),
    plane_path = function(case, one) plane_path(one, case$places[1, ], case$places[2, ]),
    reference_path = function(case, one)
      reference_path(one, case$places[1, ], case$places[2, ], "plane"),
    `reference_path, ridge` = function(case, one)
      reference_path(one, case$places[1, ], case$places[2, ], "ridge", 15),
    ridge_curve = function(case, one)
      ridge_curve(one, case$places[1, ], case$places[2, ], "plane", n = 5),
    frechet_mean = function(case, one) frechet_mean(one, case$places),
    locate = function(case, one) locate(one, case$places),
    draw_surface = function(case, one) draw_surface(one, engine = "picture"),
    write_mesh = function(case, one) write_mesh(one, temporary(".ply")),
    find_landmarks = function(case, one) find_landmarks(one),
    suggest_landmarks = function(case, one) suggest_landmarks(one, 15, n = 2),
    snap = function(case, one) snap(one, case$places, "ridge", radius = 15, reach = 10),
    build_scheme = function(case, one) build_scheme(one, launch.browser = FALSE),
    place_landmarks = function(case, one)
      place_landmarks(one, case$shape$scheme, launch.browser = FALSE),
    path_coordinates = function(case, one) path_coordinates(one, case$path, 10),
    lift = function(case, one)
      lift(one, case$coordinates, case$path, c(0, attr(case$path, "length")), c(0, 0))
  )
}

# Every exported function that takes a specimen alone.
specimen_calls <- function() {
  list(
    fit_shape = function(case, one)
      fit_shape(one, case$shape$scheme, ridge_settings(error = FALSE), progress = FALSE),
    fit_shapes = function(case, one) {
      found <- fit_shapes(list(one), case$shape$scheme, progress = FALSE)
      lost <- failures(found)
      if (nrow(lost) && lost$stage != "unforeseen")
        crestline_abort(lost$message, lost$remedy, lost$stage)
      found
    },
    plot = function(case, one) plot(one, "plain", engine = "picture"),
    plot_cuts = function(case, one)
      plot(one, what = "cuts", from = "lowL", to = "highR", engine = "picture"),
    landmark_template = function(case, one) landmark_template(one),
    calibrate_template = function(case, one)
      calibrate_template(landmark_template(case$specimen), one),
    refine_landmarks = function(case, one) refine_landmarks(one, case$defined),
    review_landmarks = function(case, one)
      review_landmarks(one, case$shape$scheme, launch.browser = FALSE),
    digitise = function(case, one)
      digitise(list(one), case$shape$scheme, launch.browser = FALSE),
    check_placing = function(case, one) check_placing(one),
    second_opinion = function(case, one) second_opinion(one, case$places),
    check_scheme = function(case, one) check_scheme(case$shape$scheme, one),
    plot_placing = function(case, one) plot(one, what = "placing"),
    plot_refinement = function(case, one) plot(one, what = "refinement"),
    simulate_faces = function(case, one)
      simulate_faces(2, template = one, effect = 0, progress = FALSE),
    write_page = function(case, one)
      write_page(one, temporary(".html"), surface = "plain", selfcontained = FALSE)
  )
}

# Calls with the right specimen, and something of it that was damaged.
damaged_calls <- function() {
  row_with <- function(case, ...) within_list(case$row, ...)
  path_with <- function(case, column, value) {
    case$path[[column]][3] <- value
    case$path
  }
  points_with <- function(case, column, value) tampered(case$shape, function(x) {
    x$points[[column]][which(!is.na(x$points$x))[60]] <- value
    x
  })
  in_path <- function(case, value) tampered(case$shape, function(x) {
    x$paths[["floor left"]]$face[2] <- value
    x
  })
  in_track <- function(case, column, value) tampered(case$shape, function(x) {
    x$tracks[["floor left"]]$path[[column]][2] <- value
    x
  })
  values <- list(`far out` = 1000000000L, zero = 0L, negative = -3L, half = 1.5, infinite = Inf)
  of_values <- function(make) lapply(values, function(value) {
    force(value)
    function(case) make(case, value)
  })
  each <- list(
    `plane_path, row` = of_values(function(case, v)
      plane_path(case$specimen, row_with(case, face = v), "highL")),
    `plane_path, numbers` = of_values(function(case, v)
      plane_path(case$specimen, unlist(row_with(case, face = v)[crestline:::mesh_columns]),
                 "highL")),
    `path_coordinates, path` = of_values(function(case, v)
      path_coordinates(case$specimen, path_with(case, "face", v), 10)),
    `path_coordinates, weights` = list(wrong = function(case)
      path_coordinates(case$specimen, path_with(case, "w1", 5), 10)),
    `path_coordinates, no column` = list(w1 = function(case)
      path_coordinates(case$specimen, case$path[setdiff(names(case$path), "w1")], 10)),
    `lift, path` = of_values(function(case, v) {
      lift(case$specimen, case$coordinates, path_with(case, "face", v),
           c(0, attr(case$path, "length")), c(0, 0))
    }),
    `lift, vertices` = of_values(function(case, v) {
      case$coordinates$vertex[1] <- v
      lift(case$specimen, case$coordinates, case$path, c(0, attr(case$path, "length")), c(0, 0))
    }),
    `reference_path, curvature` = list(cut = function(case) {
      short <- tampered(case$curvature, function(x) within_list(x, k1 = x$k1[1:9]))
      reference_path(case$specimen, "lowL", "highR", "ridge", short)
    }, `cut alike` = function(case) {
      short <- tampered(case$curvature, function(x)
        lapply(x, function(part) if (is.matrix(part)) part[1:9, ] else part[1:9]))
      reference_path(case$specimen, "lowL", "highR", "ridge",
                     structure(short, key = attr(case$curvature, "key"), radius = 15))
    }),
    `slide, points` = of_values(function(case, v)
      slide(points_with(case, "face", v), case$template)),
    `slide, paths` = of_values(function(case, v) slide(in_path(case, v), case$template)),
    `slide, tracks` = of_values(function(case, v) slide(in_track(case, "face", v), case$template)),
    `slide, arc lengths` = list(falling = function(case)
      slide(in_track(case, "s", -1), case$template)),
    `slide, track points` = list(infinite = function(case) slide(tampered(case$shape, function(x) {
      x$tracks[["floor left"]]$s[2] <- Inf
      x
    }), case$template)),
    `homologise, tracks` = of_values(function(case, v) {
      homologise(list(in_track(case, "face", v)), case$template, rounds = 0, progress = FALSE)
    }),
    `shape_mesh, points` = of_values(function(case, v)
      shape_mesh(points_with(case, "face", v), specimen = case$specimen, dense = 2)),
    `shape_mesh, rows` = list(lost = function(case) {
      shape_mesh(tampered(case$shape, function(x) within_list(x, points = x$points[-1, ])),
                 specimen = case$specimen, dense = 2)
    }),
    `patch_mesh, paths` = of_values(function(case, v)
      patch_mesh(in_path(case, v), case$specimen, "cheek left", 5, 5)),
    `surface_faults, points` = of_values(function(case, v)
      surface_faults(points_with(case, "face", v), case$specimen)),
    `plot.shape, points` = of_values(function(case, v)
      plot(points_with(case, "face", v), case$specimen, surface = "plain", engine = "picture")),
    `plot.curve, path` = of_values(function(case, v) {
      case$curve$path$face[2] <- v
      plot(case$curve, case$specimen, "plain", engine = "picture")
    }),
    `a template on a mesh` = list(surface_faults = function(case)
      surface_faults(case$template, case$specimen),
                                  slide = function(case)
                                    slide(case$template, case$template, specimen = case$specimen))
  )
  unlist(each, recursive = FALSE)
}

# The case with what some calls need besides: a scheme with a definition, and a curve to be given.
complete_case <- function() {
  case <- own_mesh_case()
  tables <- paired_tables()
  tables$definitions <- data.frame(landmark = "high", kind = "cap", radius = 15, reach = 10)
  case$defined <- do.call(curve_scheme, c(tables, name = "defined"))
  case$across <- ridge_curve(case$specimen, "lowL", "lowR", "plane", n = 5)
  case
}

# Calls that were not refused by name, as text.
not_refused <- function(calls, case, wrong) {
  # Most of the time of an error is its backtrace, which nobody reads here.
  rlang::local_options("rlang:::disable_trace_capture" = TRUE)
  said <- lapply(names(calls), function(call) {
    lapply(names(wrong), function(name) {
      refused <- tryCatch({
        suppressWarnings(draw_quietly(calls[[call]](case, wrong[[name]]), 150, 150))
        "answered"
      }, crestline_error = function(e) NULL, error = function(e) conditionMessage(e))
      if (!is.null(refused)) paste(call, name, refused, sep = ": ")
    })
  })
  unlist(said)
}

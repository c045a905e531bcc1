# Every exported function with a wrong value for every argument: the calls, the values, what may
# come of them.

# Values that are wrong for most arguments.
wrong_values <- function() {
  list(
    null = NULL, na = NA, na_character = NA_character_, na_real = NA_real_, true = TRUE, zero = 0,
    minus_one = -1, half = 0.5, inf = Inf, minus_inf = -Inf, nan = NaN, big = 1e10,
    beyond_integer = 2^31, huge = 1e300, tiny = 1e-300, no_numbers = numeric(),
    two_numbers = c(1, 2), number_and_na = c(1, NA), string = "zzz", no_strings = character(),
    two_strings = c("a", "b"), empty = "", long = strrep("x", 20000), empty_list = list(),
    list = list(1), list_of_na = list(a = NA), table = data.frame(x = 1),
    empty_table = data.frame(), fun = mean, matrix = matrix(1:4, 2), array = array(1, c(2, 2, 2)),
    factor = factor("a"), complex = 1i, date = as.Date("2020-02-20"), environment = new.env(),
    formula = y ~ x, call = quote(f(x)), raw = as.raw(1),
    damaged_mesh = structure(list(), class = "mesh3d"),
    damaged_specimen = structure(list(), class = "specimen"),
    damaged_shape = structure(list(), class = "shape"),
    shapeless = structure(list(points = 1, status = 1, id = "a", scheme = 1), class = "shape")
  )
}

# The values that an argument of each kind may take: they are refused or not, but never by an error
# of R's own.
lawful_values <- function() {
  numbers <- c("zero", "minus_one", "half", "big", "beyond_integer", "huge", "tiny")
  list(
    object = character(), choice = character(), flag = "true", count = "zero",
    number = numbers, reach = c(numbers, "inf"), numbers = c(numbers, "two_numbers", "no_numbers"),
    text = c("string", "empty", "long"), id = c("string", "empty", "long", names(wrong_values())),
    names = c("string", "two_strings", "no_strings", "empty", "long"),
    colour = c("zero", "half", "tiny", "two_numbers", "big", "beyond_integer"),
    any = names(wrong_values())
  )
}

# The folder of a desk with one record.
made_desk <- function(one, dir) {
  scheme <- curve_scheme(data.frame(landmark = rownames(one$landmarks)),
                         data.frame(curve = "c", from = "aL", to = "aR", kind = "plane", n = 5))
  review <- begin_review(one, scheme, 0.5, ridge_settings(), 0.2, 1, "AB")
  keep_review(review, dir)
  dir
}

# A small ball with landmarks, and what is measured on it: cheap, so that thousands of calls are.
argument_objects <- function() {
  ball <- Rvcg::vcgSphere(3)
  ball <- structure(list(vb = rbind(50 * ball$vb[1:3, ], 1), it = ball$it), class = "mesh3d")
  corners <- rbind(aL = c(1, 1, 2), aR = c(-1, 1, 2), bL = c(1, -1, 2), bR = c(-1, -1, 2),
                   n = c(0, 1.2, 2), sn = c(0, -1.2, 2))
  corners <- 50 * corners / sqrt(rowSums(corners^2))
  scheme <- curve_scheme(
    data.frame(landmark = rownames(corners)),
    data.frame(curve = c("top", "bottom", "side L", "side R"), from = c("aL", "bL", "aL", "aR"),
               to = c("aR", "bR", "bL", "bR"), kind = "plane", n = c(7, 7, 5, 5)),
    patches = data.frame(patch = "mid", curve_a = "top[1:7]", curve_b = "bottom[1:7]",
                         columns = "1:7", rows = 5, rows_kept = "1:5", n = 35, outward = "columns"),
    pairs = data.frame(level = c("landmarks", "landmarks", "curves"),
                       left = c("aL", "bL", "side L"), right = c("aR", "bR", "side R")),
    name = "quad"
  )
  one <- function(i) {
    mesh <- ball
    mesh$vb[3, ] <- mesh$vb[3, ] * (1 + 0.02 * i)
    mesh$vb[1, ] <- mesh$vb[1, ] * (1 + 0.01 * i^2)
    specimen(mesh, corners * rep(c(1 + 0.01 * i^2, 1, 1 + 0.02 * i), each = 6), id = paste0("s", i),
             tolerance = 0.05)
  }
  specimens <- lapply(0:6, one)
  names(specimens) <- vapply(specimens, `[[`, "", "id")
  shapes <- lapply(specimens, fit_shape, scheme, progress = FALSE)
  list(ball = ball, corners = corners, scheme = scheme, specimens = specimens, shapes = shapes)
}

# Measurements of the ball of argument_objects().
ball_measurements <- function() {
  data.frame(measurement = c("width", "height", "corner", "index", "arc", "face", "dent", "room"),
             kind = c("distance", "distance", "angle", "ratio", "length", "area", "depth",
                      "volume"),
             of = c("aL + aR", "n + sn", "aL + n + aR", "width + height", "top + bottom", "mid",
                    "n", "mid"),
             base = c(NA, NA, NA, NA, NA, NA, "aL + aR", "aL + aR + sn"))
}

# The ball as if its landmarks had been found.
found_ball <- function(one) {
  at <- one$landmarks
  one$placing <- data.frame(landmark = rownames(at), state = "found", confidence = 0.9, moved = 0,
                            sd = 0, residual = 0, lost = 0, x = at[, 1], y = at[, 2], z = at[, 3],
                            row.names = NULL)
  one$match <- list(unit = 1, doubtful = FALSE)
  one
}

# Arguments of a call that works, and the kind of each, by function. Kinds: names of
# lawful_values(); with "?": NULL too.
argument_calls <- function(made = argument_objects(), folder = tempfile()) {
  dir.create(folder)
  path <- function(name) file.path(folder, name)
  one <- made$specimens[[1]]
  shape <- made$shapes[[1]]
  curved <- curvature(one, 20)
  curve <- suppressWarnings(ridge_curve(one, "aL", "aR", "ridge", curved, 20, 7))
  path_on <- plane_path(one, "aL", "aR")
  at <- path_coordinates(one, path_on, 15)
  surface <- curvature_surface(at, cos(at$d / 10))
  sample <- homologise(made$shapes, specimens = made$specimens, rounds = 1, progress = FALSE)
  aligned <- align(sample, "curves")
  template <- landmark_template(one)
  grDevices::pdf(NULL)
  scene <- draw_surface(one$mesh, engine = "picture", resolution = 5, samples = 1)
  write_mesh(one, path("s.ply"))
  write_landmarks(one$landmarks, path("s.csv"))
  line <- coords(shape, "curves")[1:7, ]
  ridge <- curve_scheme(cbind(landmark = rownames(made$corners),
                              as.data.frame(made$corners) |> stats::setNames(c("x", "y", "z"))),
                        data.frame(curve = "top", from = "aL", to = "aR", kind = "ridge", n = 5,
                                   radius = 20, width = 20))
  ridged <- suppressWarnings(lapply(made$specimens[1:2], fit_shape, ridge, progress = FALSE))
  people <- data.frame(age = 5 + (0:41) / 4, sex = c("female", "male"))
  cohort <- simulate_cohort(42, data = people, template = symmetrise(shape), seed = 1)
  quick <- norm_settings(components = 2, radii = 15, ranges = c(10, 30), bins = c(0, 1, 20, 70),
                         folds = 2, least = 1)
  norms <- fit_norms(cohort$sample, data = cohort$data, settings = quick, progress = FALSE)
  write_norms(norms, path("norms_read"))
  if (requireNamespace("nanoparquet", quietly = TRUE)) write_blocks(sample, path("blocks_read"))
  faces <- NULL
  fitted <- list(measuring = shape_settings(column_angles = 5))
  fitted_kinds <- c(measuring = "object")
  given <- function(...) list(...)
  entry <- function(.args, ...) list(args = .args, kinds = c(...))
  # A function of settings: kinds that are not given are those of the default's type.
  fields <- function(maker, ...) {
    args <- lapply(as.list(formals(maker))[-match("...", names(formals(maker)))], eval)
    kind <- vapply(args, function(value) {
      if (is.character(value)) "choice" else if (is.logical(value)) "flag" else
        if (length(value) > 1) "numbers" else "number"
    }, "")
    kind[names(c(...))] <- c(...)
    list(args = args, kinds = kind)
  }
  list(
    align = entry(given(sample = sample, level = "curves", scale = TRUE, weights = NULL,
                        missing = "drop", tangent = TRUE, triangles = NULL,
                        limits = sample_limits(), settings = align_settings()),
                  limits = "object", settings = "object", sample = "object", level = "choice",
                  scale = "flag", weights = "object?", missing = "choice", tangent = "flag",
                  triangles = "object?"),
    align_settings = fields(align_settings, rounds = "count", dir = "text?"),
    as_aligned = entry(given(x = aligned$coords, size = NULL, level = "points", triangles = NULL),
                       x = "object", size = "numbers?", level = "text", triangles = "object?"),
    as_geomorph = entry(given(sample = sample, level = "curves", data = NULL), sample = "object",
                        level = "choice", data = "any"),
    as_morpho = entry(given(sample = sample, level = "curves"), sample = "object",
                      level = "choice"),
    as_rrpp = entry(given(sample = sample, level = "curves", data = NULL), sample = "object",
                    level = "choice", data = "any"),
    asymmetry = entry(given(shape = shape, by = "part", off_middle = 0.5), shape = "object",
                      by = "choice", off_middle = "number"),
    bending_energy = entry(given(template = sample$template, nugget = 0, level = "curves",
                                 tolerance = 1e-6),
                           template = "object", nugget = "numbers", level = "choice",
                           tolerance = "number"),
    build_scheme = entry(given(mesh = one, scheme = made$scheme, dir = NULL, radius = 20,
                               points = 9, settings = ridge_settings(), view = "front", faces = 100,
                               no_such_argument = 1),
                         mesh = "object", scheme = "object?", dir = "text?", radius = "number",
                         points = "count", settings = "object", view = "numbers", faces = "count"),
    calibrate_template = entry(given(template = template, specimens = made$specimens[1], rounds = 1,
                                     settings = find_settings(), threads = 1L),
                               template = "object", specimens = "object", rounds = "count",
                               settings = "object", threads = "count"),
    check_placing = entry(given(specimen = one, least = 0.5, doubtful = 0, picture = NULL),
                          specimen = "object", least = "number", doubtful = "number",
                          picture = "any"),
    compare_groups = entry(given(sample = sample, group = rep(c("A", "B"), c(3, 4)),
                                 level = "curves", n_perm = 5, block = NULL, seed = 1,
                                 equal_spread = TRUE, progress = FALSE,
                                 settings = comparison_settings(tests = "size", exact = 5,
                                                                n_boot = 5, missing = "drop")),
                           block = "any", equal_spread = "flag", settings = "object",
                           sample = "object", group = "object", level = "choice", n_perm = "count",
                           seed = "number?", progress = "flag"),
    comparison_settings = fields(comparison_settings, n_boot = "count", exact = "number?",
                                 permutations = "any", weights = "any", scale = "flag"),
    check_scheme = entry(given(scheme = made$scheme, specimen = one,
                               settings = ridge_settings(error = FALSE), beside = 0.3, unit = NULL,
                               threads = 1L),
                         scheme = "object", specimen = "object", settings = "object",
                         beside = "number", unit = "number?", threads = "count"),
    coords = entry(given(x = shape, level = "curves", part = NULL), x = "object",
                   level = "choice", part = "any"),
    curvature = entry(given(mesh = one, radius = 20, order = "adaptive", threads = 1L,
                            vertices = 1:5, shrinkage = 6, points_per_term = 1.5, one_sided = 0.2,
                            widen = 2.25),
                      mesh = "object", radius = "number", order = "choice", threads = "count",
                      vertices = c("numbers?"), shrinkage = "number", points_per_term = "number",
                      one_sided = "number", widen = "number"),
    curvature_surface = entry(given(coordinates = at, strength = cos(at$d / 10),
                                    settings = ridge_settings()),
                              coordinates = "object", strength = "object", settings = "object"),
    curve_distance = entry(given(a = list(x = line), b = list(x = line + 1), match = "none",
                                 between = "points", level = "curves", scale = FALSE),
                           a = "object", b = "object", match = "choice", between = "choice",
                           level = "choice", scale = "flag"),
    curve_scheme = entry(given(landmarks = made$scheme$landmarks,
                               curves = as.data.frame(made$scheme)[,
                                                                   c("curve", "from", "to", "kind",
                                                                     "n")], patches = NULL,
                               pairs = NULL, strips = NULL, name = "n", definitions = NULL,
                               tracks = NULL),
                         landmarks = "object", curves = "object", patches = "object?",
                         pairs = "object?", strips = "object?", name = "text",
                         definitions = "object?", tracks = "object?"),
    curvedness = entry(given(x = curved, k2 = NULL), x = "any", k2 = "any"),
    draw_band = entry(given(scene = scene, left = line[1:5, ], right = line[2:6, ],
                            colour = "black", opacity = 0.4),
                      scene = "object", left = "object", right = "object", colour = "colour",
                      opacity = "number"),
    # No page is opened: the argument that is checked last is wrong.
    crestline_app = entry(given(dir = "x", port = 8000, no_such_argument = 1),
                          dir = "text", port = "count?"),
    # No page is opened: the argument that is checked last is wrong already.
    digitise = entry(given(specimens = list(one), scheme = made$scheme, dir = NULL,
                           observer = "AB", blank = TRUE, settings = ridge_settings(),
                           view = NULL, page = review_settings(), no_such_argument = 1),
                     specimens = "object", scheme = "object", dir = "text?", observer = "text",
                     blank = "flag", settings = "object", view = "numbers?", page = "object"),
    draw_lines = entry(given(scene = scene, x = line, colour = "black", width = 2, halo = NA,
                             name = NULL),
                       scene = "object", x = "object", colour = "colour", width = "number",
                       halo = "halo", name = "any"),
    draw_points = entry(given(scene = scene, x = line, colour = "black", size = 1, halo = NA,
                              labels = NULL, name = NULL),
                        scene = "object", x = "object", colour = "colour", size = "number",
                        halo = "halo", labels = "any", name = "any"),
    draw_surface = entry(given(mesh = one$mesh, colour = "#D8C3B0", view = "front",
                               engine = "picture"),
                         mesh = "object", colour = "colour", view = "numbers", engine = "choice"),
    drawing_engine = entry(given()),
    face_effect = entry(given()), face_scheme = entry(given()), face_template = entry(given()),
    failures = entry(given(x = made_batch(made)), x = "object"),
    find_landmarks = entry(given(mesh = one, template = template, id = NULL,
                                 settings = find_settings(), unit = NULL, threads = 1L),
                           mesh = "object", template = "object", id = "id?", settings = "object",
                           unit = "number?", threads = "count"),
    find_settings = fields(find_settings),
    curve_route = fields(curve_route, keep_away = "list?", path = "choice", via = "any",
                         trust = "size", reach = "reach"),
    shape_settings = fields(shape_settings, column_angles = "count"),
    fit_shape = entry(c(given(specimen = one, scheme = made$scheme, settings = ridge_settings(),
                              curves = NULL), fitted,
                        given(unit = NULL, threads = 1L, progress = FALSE)),
                      specimen = "object", scheme = "object", settings = "object", curves = "any",
                      fitted_kinds, unit = "number?", threads = "count", progress = "flag"),
    fit_shapes = entry(given(x = made$specimens[1:2], scheme = made$scheme, dir = NULL,
                             landmarks = NULL, template = NULL, doubtful = 0, found = NULL,
                             reading = list(), progress = FALSE),
                       found = "flag?", reading = "any", x = "names", scheme = "object",
                       dir = "any", landmarks = "any", template = "object?", doubtful = "number",
                       progress = "flag"),
    frechet_mean = entry(given(mesh = one, points = made$corners, weights = NULL, rings = 1),
                         mesh = "object", points = "object", weights = "any", rings = "count"),
    locate = entry(given(mesh = one, xyz = made$corners), mesh = "object", xyz = "object"),
    run_command = entry(given(arguments = c("find", "--help")), arguments = "names"),
    sample_limits = entry(given(far = 8, point = 8, size = 5, estimated = 0.3, beyond = 0.5,
                                fewest = 6), far = "reach",
                          point = "reach", size = "reach", estimated = "reach", beyond = "reach",
                          fewest = "count"),
    warnings_of = entry(given(x = made_batch(made)), x = "object"),
    write_parquet = entry(given(x = made$shapes[1], file = path("table.parquet"), what = "points",
                                form = "long", specimens = NULL),
                          x = "object", file = "text", what = "choice", form = "choice",
                          specimens = "any"),
    homologise = entry(given(shapes = made$shapes[1:2], template = NULL,
                             settings = slide_settings(), specimens = made$specimens,
                             tolerance = 1e-2, rounds = 1, progress = FALSE, red = "keep",
                             limits = quality_limits()),
                       shapes = "object", template = "object?", settings = "object",
                       specimens = "any", tolerance = "number", rounds = "count",
                       progress = "flag", red = "choice", limits = "object"),
    keep_away = entry(given(from = "aL", to = "aR", radius = 0.7, extension = 0.2),
                      from = "name", to = "name", radius = "number", extension = "number"),
    keep_side = entry(given(from = "aL", to = "aR", towards = "n"), from = "name", to = "name",
                      towards = "name"),
    face_measurements = entry(given()),
    measurements = entry(given(x = shape, table = ball_measurements(), error = 1, draws = 5,
                               range = 5, seed = 1),
                         x = "object", table = "object", error = "numbers?", draws = "count",
                         range = "number?", seed = "number?"),
    cohort_settings = fields(cohort_settings, variation = "object", holes = "count",
                             population = "count"),
    simulate_cohort = entry(given(n = 2, ages = c(5, 20), data = NULL, lesions = NULL, visits = 1,
                                  template = symmetrise(shape), settings = cohort_settings(),
                                  seed = 1),
                            n = "count", ages = "numbers", data = "object?", lesions = "object?",
                            visits = "count", template = "object?", settings = "object",
                            seed = "number?"),
    noise_settings = fields(noise_settings, points = "count", rounds = "count"),
    norm_settings = fields(norm_settings, components = "count?", k = "count?", k_spread = "count?",
                           folds = "count?"),
    fit_norms = entry(given(sample = cohort$sample, formula = ~ s(age, by = sex),
                            data = cohort$data, table = NULL, about = list(), share = FALSE,
                            settings = quick, progress = FALSE),
                      sample = "object", formula = "object", data = "object", table = "object?",
                      about = "object", share = "flag", settings = "object", progress = "flag"),
    assess = entry(given(shape = cohort$sample[[1]], norms = norms, age = 10, sex = "female",
                         error = NULL, alpha = 0.05),
                   shape = "object", norms = "object", age = "number", sex = "choice",
                   error = "any", alpha = "number"),
    write_blocks = entry(given(sample = sample, dir = path("blocks"), block = 3, triangles = NULL),
                         sample = "object", dir = "text", block = "count", triangles = "object?"),
    write_norms = entry(given(norms = norms, dir = path("norms"), share = FALSE),
                        norms = "object", dir = "text", share = "flag"),
    read_digitised = entry(given(dir = made_desk(one, path("desk")), observer = NULL,
                                 specimens = NULL, scheme = made$scheme),
                           dir = "text", observer = "names?", specimens = "object?",
                           scheme = "object"),
    read_norms = entry(given(dir = path("norms_read")), dir = "object"),
    visit_settings = fields(visit_settings, rounds = "count", draws = "count", seed = "number?"),
    compare_visits = entry(given(before = cohort$sample[[1]], after = cohort$sample[[2]],
                                 error = 0.2, unchanged = "mid", table = NULL, norms = norms,
                                 ages = c(10, 11), sex = "female", settings = visit_settings()),
                           before = "object", after = "object", error = "number?",
                           unchanged = "any", table = "object?", norms = "object?",
                           ages = "numbers", sex = "choice", settings = "object"),
    visit_errors = entry(given(shapes = cohort$sample$shapes[1:2], specimen = c("a", "a"),
                               pool = 30, settings = repeat_settings()),
                         shapes = "object", specimen = "any", pool = "number",
                         settings = "object"),
    repeat_settings = fields(repeat_settings, rounds = "count", bins = "count",
                             fewest = "count"),
    landmark_template = entry(given(specimen = one, predicted = character(), unit = 1, mirror = NA,
                                    start = NULL, hinge = character(), moves = character(),
                                    slit = character()),
                              specimen = "object", predicted = "any", unit = "number",
                              mirror = "any", start = "any", hinge = "any", moves = "any",
                              slit = "any"),
    learn_tracks = entry(given(shapes = ridged, fewest = 2, least = 0.1, places = 5),
                         shapes = "object", fewest = "count", least = "number", places = "count"),
    lift = entry(given(specimen = one, coordinates = at, path = path_on, s = c(5, 10),
                       alpha = c(0, 0)),
                 specimen = "object", coordinates = "object", path = "object", s = "numbers",
                 alpha = "numbers"),
    patch_mesh = entry(c(given(x = shape, specimen = one, patch = "mid", columns = NULL,
                               rows = NULL, block = NULL), fitted),
                       x = "object", specimen = "object", patch = "choice", columns = "count?",
                       rows = "count?", block = "any", fitted_kinds),
    open_sample = entry(given(dir = path("blocks_read")), dir = "object"),
    path_coordinates = entry(given(specimen = one, path = path_on, width = 10, margin = 10),
                             specimen = "object", path = "object", width = "number",
                             margin = "number"),
    picture_settings = entry(given(light = c(0, 0, 1), ambient = 0.3, wrap = 0.4, gloss = 0.1,
                                   sharpness = 20, resolution = 10, samples = 1, margin = 0.02,
                                   around = NULL, tolerance = 0.005, inside = NA),
                             light = "object", ambient = "number", wrap = "number",
                             gloss = "number", sharpness = "number", resolution = "number",
                             samples = "count", margin = "number", around = "object?",
                             tolerance = "number", inside = "halo"),
    place_landmarks = entry(given(mesh = one, scheme = made$scheme, id = "x", no_such_argument = 1),
                            mesh = "object", scheme = "object", id = "id?"),
    plane_path = entry(given(mesh = one, from = "aL", to = "aR", angle = 0, side = 0, reach = Inf),
                       mesh = "object", from = "object", to = "object", angle = "number",
                       side = "number", reach = "reach"),
    plot_curves = entry(given(curves = list(curve), specimen = one, surface = "plain",
                              colour = NULL, band = TRUE, points = TRUE, width = 2.5,
                              landmarks = FALSE, engine = "picture", legend = TRUE, resolution = 5,
                              samples = 1),
                        curves = "list", specimen = "object", surface = "choice",
                        colour = "colour?", band = "flag", points = "flag", width = "number",
                        landmarks = "flag", engine = "choice", legend = "flag",
                        resolution = "number", samples = "count"),
    plot_cuts = entry(given(specimen = one, from = "aL", to = "aR", angles = c(-0.5, 0),
                            surface = "plain", width = 2.5, engine = "picture", resolution = 5,
                            samples = 1),
                      specimen = "object", from = "object", to = "object", angles = "numbers",
                      surface = "choice", width = "number", engine = "choice",
                      resolution = "number", samples = "count"),
    plot_panel = entry(given(x = curve, points = TRUE, grid = c(30, 20), palette = c("red", "blue"),
                             contours = 8, colour = "#16218C", main = NULL),
                       x = "object", points = "flag", grid = "numbers", palette = "colour",
                       contours = "count", colour = "colour", main = "any"),
    plot_placing = entry(given(specimen = one, least = 0.5, views = 0), specimen = "object",
                         least = "number", views = "numbers"),
    plot_refinement = entry(given(specimen = one, view = "front", labels = TRUE, main = NULL),
                            specimen = "object", view = "any", labels = "any", main = "any"),
    plot_shape_scale = entry(given(curvedness = 0.45, spacing = 3, turn = 0.35, tilt = 0.85,
                                   palette = NULL, resolution = 5, samples = 1),
                             palette = "any", curvedness = "number", spacing = "number",
                             turn = "number", tilt = "number", resolution = "number",
                             samples = "count"),
    quality = entry(given(x = shape, limits = quality_limits(), others = NULL), x = "list",
                    limits = "object", others = "any"),
    quality_limits = fields(quality_limits, others = "count"),
    quality_report = entry(given(x = made$shapes[1:2], file = path("q.html"), specimens = NULL,
                                 limits = quality_limits(), others = NULL, title = "t",
                                 pictures = 0, size = c(300, 200)),
                           x = "list", file = "object", specimens = "any", limits = "object",
                           others = "any", title = "text", pictures = "count", size = "size"),
    read_batch = entry(given(x = made_result(made, path("s.shape"))), x = "object"),
    read_curves = entry(given(file = system.file("extdata", "demo_curves.csv",
                                                 package = "crestline"), curves = NULL),
                        file = "object", curves = "any"),
    read_landmarks = entry(given(file = path("s.csv"), frame = "LPS", missing = 9999, scale = TRUE),
                           file = "object", frame = "choice", missing = "any", scale = "flag"),
    read_scheme = entry(given(dir = system.file("extdata", "skull_scheme", package = "crestline"),
                              name = "n"),
                        dir = "object", name = "text"),
    read_specimen = entry(given(file = path("s.ply"), landmarks = path("s.csv"), id = "x",
                                names = NULL),
                          names = "object?", file = "object", landmarks = "any", id = "id?"),
    path_settings = fields(path_settings, reach = "reach", longest = "reach", angles = "count",
                           refined = "count", limited = "count"),
    reference_path = entry(given(specimen = one, from = "aL", to = "aR", type = "ridge",
                                 radius = curved, keep_away = NULL,
                                 settings = path_settings(angles = 5, refined = 3),
                                 path = "plane", via = NULL),
                           specimen = "object", from = "object", to = "object", type = "choice",
                           radius = "number", keep_away = "list?", settings = "object",
                           path = "choice", via = "object?"),
    refine_landmarks = entry(given(specimen = one, scheme = made$scheme, move = FALSE,
                                   settings = refine_settings(), curvature = NULL, unit = NULL,
                                   threads = 1L),
                             specimen = "object", scheme = "object", move = "any",
                             settings = "object", curvature = "any", unit = "number?",
                             threads = "count"),
    refine_settings = fields(refine_settings, rounds = "count", order = "choice"),
    repeatability = entry(given(shapes = made$shapes[1:4], specimen = c("a", "a", "b", "b"),
                                observer = NULL, level = "curves", match = "specimen"),
                          shapes = "object", specimen = "object", observer = "object?",
                          level = "choice", match = "choice"),
    # No page is opened: the argument that is checked last is wrong already.
    review_landmarks = entry(given(specimen = one, scheme = made$scheme, surface = "plain",
                                   least = 0.5, settings = ridge_settings(), view = NULL,
                                   unit = NULL, page = review_settings(), threads = 1L,
                                   no_such_argument = 1),
                             specimen = "object", scheme = "object?", surface = "choice",
                             least = "number", settings = "object", view = "numbers?",
                             page = "object", unit = "number?", threads = "count"),
    review_settings = fields(review_settings, radius = "number?", faces = "count"),
    ridge_curve = entry(given(specimen = one, from = "aL", to = "aR", type = "ridge", radius = 20,
                              width = 20, n = 7, settings = ridge_settings(),
                              route = curve_route()),
                        specimen = "object", from = "object", to = "object", type = "choice",
                        radius = "number", width = "number", n = "count", settings = "object",
                        route = "object"),
    ridge_line = entry(given(surface = surface, scale = 1, radius = 20, settings = ridge_settings(),
                             kernel = 0),
                       surface = "object", scale = "number", radius = "number", settings = "object",
                       kernel = "number"),
    ridge_settings = fields(ridge_settings, cap = "reach", window = "reach", vertices = "reach",
                            anisotropy = "reach", lambda = "reach", core = "reach", bound = "reach",
                            step = "reach", tolerance = "reach", longest = "reach",
                            inflation = "reach", undetermined = "reach", faint = "reach",
                            beside = "reach", widest = "reach", detour = "reach",
                            kernel_most = "reach", kernel_least = "reach",
                            kernel_vertices = "reach", second_gain = "reach",
                            second_whole = "reach", mix = "reach", grid = "count",
                            iterations = "count", noise = "any", passes = "count?"),
    ridge_study = entry(given(settings = ridge_settings(error = FALSE), n = 1, a = 0, b = 1,
                              noise = 0, dir = NULL, progress = FALSE,
                              study = study_settings(spacing = 0.1, points = 5)),
                        settings = "any", n = "count", a = "numbers", b = "numbers",
                        noise = "numbers", dir = "any", progress = "flag", study = "object"),
    study_settings = fields(study_settings, landmark_error = "numbers", passes = "numbers?",
                            radius = "numbers", spacing = "numbers", correlation = "numbers",
                            points = "count", block = "count"),
    scan_noise = entry(given(first = simulate_ridge(0.25, 1, 0.1, 0.01, 1),
                             second = simulate_ridge(0.25, 1, 0.1, 0.01, 2), near = NULL,
                             reach = 0.5, direction = NULL,
                             settings = noise_settings(points = 400, rounds = 5)),
                       first = "object", second = "object", near = "any", reach = "number",
                       direction = "any", settings = "object"),
    scan_settings = entry(given(noise = 0.1, noise_range = 0, remesh = TRUE, edge = NULL,
                                edge_sd = 0.05, rounds = 1, crease = 30, holes = 0, hole_radius = 5,
                                landmark_error = 0, turn = 0, shift = 0),
                          noise = "number", noise_range = "number", remesh = "flag",
                          edge = "number?", edge_sd = "number", rounds = "count", crease = "number",
                          holes = "count", hole_radius = "numbers", landmark_error = "number",
                          turn = "number", shift = "number"),
    second_opinion = entry(given(specimen = found_ball(one), landmarks = made$corners, agreed = 6,
                                 tolerance = 0.1),
                           specimen = "object", landmarks = "any", agreed = "number",
                           tolerance = "number"),
    shape_at = entry(given(pca = shape_pca(aligned), component = 1, sd = 2,
                           as = "matrix", size = 1),
                     pca = "object", component = "some", sd = "number", as = "choice",
                     size = "number"),
    shape_category = entry(given(index = c(0, 0.5)), index = "index"),
    shape_colours = entry(given(index = c(0, 0.5), missing = "#BEBEBE", palette = NULL),
                          index = "index", missing = "colour", palette = "any"),
    shape_index = entry(given(x = 1, k2 = 0.5), x = "any", k2 = "any"),
    shape_lda = entry(given(sample = sample, group = rep(c("A", "B"), c(3, 4)), components = 1,
                            level = "curves", prior = NULL, scale = TRUE, weights = NULL,
                            missing = "drop", progress = FALSE),
                      sample = "object", group = "object", components = "numbers", level = "choice",
                      prior = "numbers?", scale = "flag", weights = "object?", missing = "choice",
                      progress = "flag"),
    shape_lm = entry(given(sample = sample, formula = ~ w,
                           data = data.frame(id = names(sample), w = c(1, 3, 2, 5, 4, 7, 6)),
                           level = "curves", n_perm = 5, block = NULL, seed = 1, progress = FALSE,
                           settings = model_settings(tests = "size", missing = "drop")),
                     sample = "object", formula = "object", data = "object", level = "choice",
                     n_perm = "count", block = "any", seed = "number?", progress = "flag",
                     settings = "object"),
    model_settings = fields(model_settings, permutations = "any", contrasts = "any",
                            weights = "any"),
    shape_mesh = entry(c(given(x = shape, parts = "model", specimen = one, dense = 1), fitted),
                       x = "object", parts = "choice", specimen = "object?", dense = "count",
                       fitted_kinds),
    shape_pca = entry(given(aligned = aligned, weights = aligned$weights, tolerance = 1e-14,
                            components = 2, sized = 0.1, level = "landmarks"),
                      aligned = "object", weights = "any", tolerance = "number",
                      components = "count?", sized = "number", level = "any"),
    simulate_faces = entry(given(n = 2, effect = 2, size_effect = 0.03, template = one,
                                 places = data.frame(part = "brow", x = 0, y = 0, z = 50,
                                                     radius = 10, share = 1),
                                 scan = NULL, seed = 1, progress = FALSE,
                                 population = population_settings(waves = 5)),
                           n = "count", effect = "number", size_effect = "number",
                           template = "object?", places = "any", scan = "object?",
                           seed = "number?", progress = "flag", population = "object"),
    population_settings = fields(population_settings, groups = "two_names", variation = "object",
                                 waves = "count"),
    simulate_ridge = entry(given(a = 0.25, b = 0.5, spacing = 0.1, noise = 0, seed = NULL,
                                 jitter = 0, correlation = 0, landmark_error = 0, end = 0.95),
                           a = "number", b = "number", spacing = "number", noise = "number",
                           seed = "number?", jitter = "number", correlation = "number",
                           landmark_error = "number", end = "number"),
    slide = entry(given(shape = shape, template = sample$template, settings = slide_settings(),
                        specimen = one),
                  shape = "object", template = "object", settings = "object", specimen = "object"),
    slide_settings = fields(slide_settings, sweeps = "count", surface_sweeps = "count",
                            joint_sweeps = "count", halvings = "count"),
    snap = entry(given(mesh = one, points = "n", to = "cap", radius = 20, reach = 20, faint = 0.05,
                       threads = 1L),
                 mesh = "object", points = "object?", to = "choice", radius = "number",
                 reach = "number", faint = "number", threads = "count"),
    specimen = entry(given(mesh = made$ball, landmarks = made$corners, id = "x", outward = "detect",
                           tolerance = 0.05, debris = 0.001, midline = c("n", "sn"), rescale = 1),
                     mesh = "object", landmarks = "any", id = "id?", outward = "choice",
                     tolerance = "number", debris = "number", midline = "names?",
                     rescale = "number"),
    suggest_landmarks = entry(given(mesh = one, radius = 20, n = 2, kinds = "cap", apart = 2,
                                    faint = 0.05, share = 0.5, threads = 1L),
                              mesh = "object", radius = "number", n = "count", kinds = "choice",
                              apart = "number", faint = "number", share = "number",
                              threads = "count"),
    surface_faults = entry(given(x = shape, specimen = one, parts = "model"), x = "object",
                           specimen = "object", parts = "choice"),
    symmetrise = entry(given(shape = shape, off_middle = 0.5), shape = "object",
                       off_middle = "number"),
    symmetry_parts = entry(given(sample = sample, level = "landmarks", individual = NULL,
                                 pairs = NULL, n_perm = 5, seed = 1, scale = TRUE, weights = NULL,
                                 missing = "estimate"),
                           sample = "object", level = "choice", individual = "any", pairs = "any",
                           n_perm = "count", seed = "number?", scale = "flag", weights = "object?",
                           missing = "choice"),
    true_effect = entry(given(x = NULL, at = NULL), x = "object", at = "any"),
    true_points = entry(given(x = NULL, at = NULL), x = "object", at = "any"),
    visible_points = entry(given(scene = scene, x = line), scene = "object", x = "object"),
    widget_settings = entry(given(size = c(90, 70), triangles = 5000, balls = 20, points = 90,
                                  zoom = 0.7, alpha = 1),
                            size = "numbers", triangles = "count", balls = "count",
                            points = "count", zoom = "number", alpha = "number"),
    write_morphologika = entry(given(x = sample, file = path("k.txt"), level = "landmarks",
                                     group = NULL),
                               x = "object", file = "object", level = "any", group = "object?"),
    write_morphoj = entry(given(x = sample, file = path("j.txt"), level = "landmarks",
                                group = NULL),
                          x = "object", file = "object", level = "any", group = "object?"),
    read_registered = entry(given(files = path("s.ply")), files = "object"),
    carry_points = entry(given(x = t(one$mesh$vb[1:3, 1:5]), from = one$mesh,
                               to = replicate(2, t(one$mesh$vb[1:3, ])), most = 0.01),
                         x = "object", from = "object", to = "object", most = "number"),
    write_slicer = entry(given(x = shape, dir = path("slicer"), specimen = NULL,
                               values = list(), parts = "model"),
                         x = "object", dir = "text", specimen = "object?", values = "any",
                         parts = "choice"),
    write_picture = entry(given(x = one, file = path("w.png"), title = NULL, size = c(4, 4),
                                dpi = 40, unit = "mm", ruler = TRUE),
                          x = "any", file = "object", title = "text?", size = "numbers",
                          dpi = "number", unit = "text", ruler = "flag"),
    write_landmarks = entry(given(x = made$corners, file = path("o.csv"), curves = NULL,
                                  frame = "LPS", missing = 9999),
                            x = "list", file = "object", curves = "any", frame = "choice",
                            missing = "any"),
    write_scheme = entry(given(scheme = made$scheme, dir = path("scheme")), scheme = "object",
                         dir = "text"),
    write_glb = entry(given(x = one$mesh, file = path("o.glb"), colour = NULL, plain = "grey",
                            tube = 1, sides = 6, component = 1, sd = 3, unit = 1),
                      x = "object", file = "object", colour = "any", plain = "colour",
                      tube = "number?", sides = "count", component = "any", sd = "number",
                      unit = "number"),
    write_mesh = entry(given(x = one$mesh, file = path("o.ply"), colour = NULL, parts = "model",
                             palette = c("red", "blue"), limits = NULL, missing = "#BEBEBE",
                             ascii = FALSE),
                       x = "object", file = "object", colour = "any", parts = "any",
                       palette = "colour", limits = "size?", missing = "colour", ascii = "flag"),
    write_page = entry(given(x = one, file = path("p.html"), curves = list(curve), table = NULL,
                             title = "t", caption = NULL, surface = "plain", colour = NULL,
                             width = 4, selfcontained = FALSE, size = c(90, 80)),
                       x = "object", file = "object", curves = "list", table = "table?",
                       title = "text", caption = "text?", surface = "choice", colour = "colour?",
                       width = "number", selfcontained = "flag", size = "size"),
    write_pca_page = entry(given(x = flat_pca(made), file = path("z.html"), component = 1, sd = 3,
                                 colour = "#E3CDB8", title = "t", size = c(42, 46), view = "front",
                                 selfcontained = FALSE),
                           x = "object", file = "object", component = "some", sd = "number",
                           colour = "colour", title = "text", size = "size", view = "numbers",
                           selfcontained = "flag")
  )
}

# A result of fit_shapes(), without futures.
made_result <- function(made, file) {
  crestline:::keep(made$shapes[[1]], list(key = "k", mesh = "m", id = "one", words = "plain"), file)
  file
}

made_batch <- function(made) {
  if (!rlang::is_installed(c("future", "future.apply", "progressr"))) return(NULL)
  fit_shapes(made$specimens[1:2], made$scheme, progress = FALSE)
}

# Principal components of a surface, for a page.
flat_pca <- function(made) {
  xyz <- simplify2array(lapply(made$specimens, function(one) t(one$mesh$vb[1:3, ])))
  shape_pca(align(xyz, "ball", triangles = made$ball$it,
                  settings = align_settings(rounds = 3, tolerance = 1e-3)))
}

# What a call gives: "returned", "refused", "refused without its name" (of the argument), or the
# message of an error of R's. A mesh is refused in the words of specimen(), which name the mesh.
outcome_of <- function(fn, args, argument = NULL, seconds = 20) {
  setTimeLimit(elapsed = seconds, transient = TRUE)
  # Some values are paths: what is made of them goes where it is deleted.
  old <- setwd(tempdir())
  on.exit({
    setTimeLimit()
    setwd(old)
  })
  named <- function(text) is.null(argument) || grepl(paste0("\\b", argument, "\\b"), text)
  tryCatch({
    utils::capture.output(
      suppressMessages(suppressWarnings(do.call(getExportedValue("crestline", fn), args,
                                                quote = TRUE))))
    "returned"
  }, crestline_mesh_error = function(e) "refused", crestline_error = function(e)
    if (named(conditionMessage(e)))
      "refused" else paste("refused without its name:", conditionMessage(e)),
  error = function(e) conditionMessage(e))
}

# The names of the wrong values that an argument of a kind must refuse.
unlawful_values <- function(kind) {
  plain <- sub("?", "", kind, fixed = TRUE)
  lawful <- lawful_values()
  lawful$halo <- c(lawful$colour, "na", "na_character", "na_real")
  lawful$list <- "empty_list"
  lawful$name <- c(lawful$names, lawful$numbers)
  lawful$size <- "two_numbers"
  lawful$some <- c("two_numbers", "matrix", "array")
  lawful$two_names <- "two_strings"
  lawful$index <- c("zero", "half", "minus_one", "tiny", "na", "na_real", "number_and_na",
                    "no_numbers", "nan", "true")
  lawful$table <- c("table", "empty_table")
  setdiff(names(wrong_values()), c(lawful[[plain]], if (plain != kind) "null"))
}

# One row a call: function, argument, value, outcome, and whether the value must be refused. What is
# refused as the call without a wrong value is (some objects are too small for their function)
# counts as returned.
try_arguments <- function(calls, functions = names(calls), values = function(fn, argument, kind)
  names(wrong_values())) {
  # Most of the time of an error is its backtrace, which nobody reads here.
  rlang::local_options("rlang:::disable_trace_capture" = TRUE)
  wrong <- wrong_values()
  functions <- Filter(function(fn) length(calls[[fn]]$kinds) > 0, functions)
  rows <- lapply(functions, function(fn) {
    args <- calls[[fn]]$args
    # Not worked out where every value is refused by the argument's name.
    delayedAssign("plain", outcome_of(fn, args, "the name of nothing"))
    lapply(names(calls[[fn]]$kinds), function(argument) {
      kind <- calls[[fn]]$kinds[[argument]]
      tried <- values(fn, argument, kind)
      outcome <- vapply(tried, function(value) {
        args[argument] <- wrong[value]
        outcome <- outcome_of(fn, args, argument)
        if (outcome != "refused" && outcome == plain) "returned" else outcome
      }, "")
      data.frame(fn = rep(fn, length(tried)), argument = rep(argument, length(tried)),
                 value = tried, outcome = outcome, must = tried %in% unlawful_values(kind),
                 row.names = NULL)
    })
  })
  do.call(rbind, unlist(rows, recursive = FALSE))
}

# The rows that are wrong: an error of R's own; for a value that no call may take no refusal, or one
# that does not name the argument.
leaks_of <- function(tried) {
  silent <- tried$outcome == "returned" & tried$must
  unnamed <- startsWith(tried$outcome, "refused without")
  tried[silent | (unnamed & tried$must) |
        !(unnamed | tried$outcome %in% c("returned", "refused")), ]
}

# The words of the main error of every family of functions, as a text that is read as a whole:
# _snaps/messages/messages.txt. They must not change by accident.

# What a call stops with or warns of: stage, problem and remedy, without paths of this machine.
words_of <- function(call, frame) {
  said <- tryCatch({
    utils::capture.output(value <- suppressMessages(eval(call, frame)))
    NULL
  }, crestline_error = identity, crestline_warning = identity)
  if (is.null(said)) return("nothing")
  where <- if (is.null(said$id)) said$stage else sprintf("specimen %s, %s", said$id, said$stage)
  text <- c(paste0(where, ": ", said$problem), paste("->", said$remedy))
  gsub(normalizePath(tempdir(), "/"), "<folder>", gsub(getwd(), "<here>", text, fixed = TRUE),
       fixed = TRUE)
}

provoked_calls <- function() {
  list(
    "reading a scan" = alist(
      read_specimen(file.path(folder, "no.ply")), read_specimen(bad_ply),
      read_specimen(file.path(folder, "a.xyz")),
      specimen(list()), specimen(ball, cbind(1, 2, 3)),
      specimen(ball, rbind(a = c(90, 0, 0)), id = "ball"),
      specimen(ball, rbind(a = c(50, 0, 0), a = c(0, 50, 0)), id = "ball"), one$colour <- 1
    ),
    "reading landmarks" = alist(
      read_landmarks(file.path(folder, "no.csv")), read_landmarks(bad_csv),
      write_landmarks(one, "marks.doc"),
      write_landmarks(list(), "marks.csv"), read_curves(bad_csv)
    ),
    "finding landmarks" = alist(
      check_placing(one), refine_landmarks(one, scheme), calibrate_template(scheme, list(one)),
      landmark_template(ball), find_landmarks(ball, template = scheme)
    ),
    "curvature" = alist(
      curvature(one), curvature(one, -1), curvature(one, 20, order = "fifth"), shape_index("a"),
      shape_category(3)
    ),
    "curves" = alist(
      ridge_curve(one, "aL", "cR", "ridge", radius = 20, width = 20, n = 7),
      ridge_curve(one, "aL", "aL", "plane", n = 7),
      ridge_curve(one, "aL", "aR", "crest", radius = 20, width = 20, n = 7),
      ridge_curve(one, "aL", "aR", "ridge", n = 7), ridge_settings(lamda = 1),
      ridge_settings("other"),
      keep_away("aL", "aR", radius = -1), plane_path(one, "aL"), confint(plane, 99),
      plot(one, what = "photograph"),
      plot(plane, what = "panel"), plot(plane)
    ),
    "schemes" = alist(
      curve_scheme(data.frame(landmark = "a"),
                   data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 5)),
      curve_scheme(data.frame(name = "a"), data.frame()), read_scheme(folder)
    ),
    "whole specimens" = alist(
      fit_shape(ball, scheme), fit_shape(one, "face"), coords(shape, "points"), coords(one),
      shape_mesh(shape, "nose"), write_mesh(shape, "model.doc"), write_page(one, "page.txt"),
      quality(1), quality_limits(spread = -1), quality_report(shape, "page.txt"),
      plot(shape, other)
    ),
    "many specimens" = alist(
      fit_shapes(character(), scheme), failures(shape)
    ),
    "samples" = alist(
      homologise(one), slide(shape, one), bending_energy(one),
      symmetrise(one), asymmetry(shape, by = "curve"), frechet_mean(ball, matrix(0, 2, 2))
    ),
    "statistics" = alist(
      align(1), align(sample, "points"), shape_pca(1), shape_at(pca, 99),
      compare_groups(sample, 1:3),
      compare_groups(sample, c(1, 1, 1, 1)), repeatability(list(shape), "a"),
      curve_distance(shape, one),
      as_morpho(1)
    ),
    "simulation" = alist(
      simulate_ridge(1, 1, noise = -1), simulate_faces(0), ridge_study(n = 0),
      scan_settings(noise = -1), true_points(shape)
    )
  )
}

test_that("errors and warnings keep their words", {
  skip_if_not_installed("htmltools")
  made <- argument_objects()
  frame <- list2env(list(made = made, one = made$specimens[[1]], other = made$specimens[[2]],
  shape = made$shapes[[1]],
                         scheme = made$scheme, ball = made$ball, folder = tempfile("none"),
                         bad_ply = tempfile(fileext = ".ply"),
                         bad_csv = tempfile(fileext = ".csv")))
  writeLines("no mesh", frame$bad_ply)
  writeLines("no landmarks", frame$bad_csv)
  names(frame$bad_ply) <- names(frame$bad_csv) <- NULL
  frame$plane <- ridge_curve(frame$one, "aL", "aR", "plane", n = 7)
  frame$sample <- suppressWarnings(homologise(made$shapes[1:4], rounds = 1, progress = FALSE))
  frame$pca <- shape_pca(align(frame$sample, "landmarks"))
  files <- basename(c(frame$bad_ply, frame$bad_csv, frame$folder))
  calls <- provoked_calls()
  lines <- unlist(lapply(names(calls), function(family) {
    c(paste("#", family), "", unlist(lapply(calls[[family]], function(call) {
      words <- words_of(call, new.env(parent = frame))
      for (name in c(files, tools::file_path_sans_ext(files))) {
        words <- gsub(name, "<file>", words, fixed = TRUE)
      }
      # Lists that grow with every new setting or field, and keys of meshes, are not words.
      words <- sub("((Settings|Its fields) are).*", "\\1 ...",
                   gsub("key [0-9a-f]{8}", "key <key>", words))
      c(paste(deparse(call, 500), collapse = " "), paste0("    ", words), "")
    })))
  }))
  expect_false("    nothing" %in% lines)
  file <- tempfile(fileext = ".txt")
  writeLines(lines, file)
  expect_snapshot_file(file, "messages.txt", compare = compare_file_text)
})

# A desk of two balls with the landmarks a, b, c, d.
two_balls <- function(dir = NULL, observer = "AB", blank = TRUE) {
  balls <- list(one = quad_specimen(), two = quad_specimen(function(mesh) {
    mesh$vb[1:3, ] <- 1.1 * mesh$vb[1:3, ]
    mesh
  }, 1.1 * quad_corners()))
  desk_from(desk_sources(balls), quad_scheme(), dir, observer, blank,
            ridge_settings(error = FALSE), review_settings())
}
place_at <- function(desk, name) {
  on_current(desk, function(review) {
    at <- quad_corners()[name, ] * mesh_diagonal(review$specimen$mesh) / 50
    ray <- mesh_on_ray(review$specimen$mesh, at, at / 1e3)
    place_selected(select_landmark(review, name), ray)
  })
}
draw_at <- function(desk, curve, at) {
  on_current(desk, function(review) {
    add_knot(choose_curve(review, curve), mesh_on_ray(review$specimen$mesh, 9 * at, at / 1e3))
  })
}

test_that("next and previous keep what was done, and its way back", {
  desk <- place_at(two_balls(), "a")
  second <- turn_to(desk, 1)
  expect_equal(second$at, "two")
  expect_true(all(current_review(second)$state == "missing"))
  second <- place_at(second, "b")
  back <- turn_to(second, -1)
  expect_identical(current_review(back), current_review(desk))
  undone <- on_current(back, undo_review)
  expect_true(all(current_review(undone)$state == "missing"))
  expect_equal(current_review(on_current(undone, redo_review))$state,
               current_review(desk)$state)
  expect_match(current_review(turn_to(back, -1))$said, "no other specimen")
  expect_match(desk_words(second), "2 of 2: two (observer AB)", fixed = TRUE)
})

test_that("a desk goes on from its folder, and a second observer sees nothing of the first", {
  dir <- tempfile("desk")
  desk <- draw_at(place_at(place_at(two_balls(dir), "a"), "b"), "bottom", c(0, -0.35, 1))
  desk <- on_current(desk, function(review) place_selected(select_landmark(review, "d"), NULL))
  again <- two_balls(dir)
  before <- current_review(desk)
  after <- current_review(again)
  expect_identical(after$specimen$landmarks, before$specimen$landmarks)
  expect_identical(after$state, before$state)
  expect_identical(after$drawn$bottom$knots, before$drawn$bottom$knots)
  expect_equal(drawn_points(after), drawn_points(before), tolerance = 1e-12)
  expect_identical(after$log, before$log)
  expect_match(after$said, "Resumed after 4 steps")
  expect_equal(after$selected, "c")
  origin <- after$specimen$origin
  expect_equal(origin$time[origin$landmark == "a"], before$log$time[1])
  other <- current_review(two_balls(dir, "CD"))
  expect_true(all(other$state == "missing"))
  expect_length(other$drawn, 0)
  wrong <- list.files(file.path(dir, "AB", "records"), full.names = TRUE)
  writeLines("{}", wrong)
  expect_crestline_error(two_balls(dir), "no record of a desk")
  unlink(dir, recursive = TRUE)
})

test_that("names of files are names of their own, in the folder", {
  names <- c("a b", "a%20b", ".", "..", "a/b", "%2E/../x", "C:x")
  words <- vapply(names, file_word, "")
  expect_equal(anyDuplicated(words), 0)
  expect_false(any(grepl("^[.]|[/\\\\:]", words)))
  expect_identical(unname(vapply(words, utils::URLdecode, "")), names)
  expect_identical(file_word("Sch\u00e4del 1.v2"), "Sch\u00e4del 1.v2")
  # In one folder no two share a name on any disk.
  names <- c("Rim", "rim", "RIM", "\u00c4 b", "\u00e4 B", "Lip", "A/%", "a/%")
  words <- file_words(names)
  expect_equal(anyDuplicated(tolower(words)), 0)
  expect_identical(words[c(2, 6)], c("rim", "Lip"))
  expect_identical(enc2utf8(vapply(words, utils::URLdecode, "", USE.NAMES = FALSE)), names)
})

test_that("fit_shapes() finds the tables of a desk by the names of the scans", {
  skip_without_futures()
  skip_if_not(isTRUE(l10n_info()[["UTF-8"]]), "no UTF-8 here")
  dir <- tempfile("scans")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  files <- file.path(dir, c("a b.ply", "Sch\u00e4del 1.v2.ply"))
  for (file in files) write_mesh(quad_specimen(), file)
  desk <- desk_from(desk_sources(files), quad_scheme(), file.path(dir, "desk"), "A B", TRUE,
                    ridge_settings(error = FALSE), review_settings())
  for (i in 1:2) {
    for (name in c("a", "b", "c", "d")) desk <- place_at(desk, name)
    if (i == 1) desk <- turn_to(draw_at(desk, "bottom", c(0, -0.35, 1)), 1)
  }
  # Both scans are the same.
  folder <- file.path(dir, "desk", file_word("A B"))
  fit <- function(dir = NULL) {
    suppressWarnings(fit_shapes(files, quad_scheme(), dir, found = FALSE, landmarks = folder))
  }
  shapes <- fit(file.path(dir, "out"))
  expect_identical(nrow(failures(shapes)), 0L)
  # The curve that was drawn is measured as it was drawn, as from the desk itself
  own <- digitised_from(desk)$specimens[[1]]
  direct <- fit_shape(own, quad_scheme(), progress = FALSE)
  expect_match(status_of(shapes[[1]], "bottom")$reason, "drawn by hand (A B", fixed = TRUE)
  expect_equal(shapes[[1]]$points$x, direct$points$x, tolerance = 1e-12)
  expect_false(any(grepl("by hand", status_of(shapes[[2]], "bottom")$reason)))
  # One specimen alone, from the folder or its own table; a copy without its record says so
  table <- file.path(folder, "a b.csv")
  for (landmarks in c(folder, table)) {
    expect_equal(read_specimen(files[1], landmarks)$drawn, own$drawn, tolerance = 1e-12)
  }
  copy <- file.path(dir, "copy.csv")
  file.copy(table, copy)
  expect_message(alone <- read_specimen(files[1], copy), "1 curve (bottom), which is not measured",
                 fixed = TRUE, class = "crestline_message")
  expect_null(alone$drawn)
  # A later step is measured anew, not taken from the former results
  desk <- on_current(turn_to(desk, -1), erase_curve)
  expect_false(any(grepl("by hand", status_of(fit(file.path(dir, "out"))[[1]], "bottom")$reason)))
  record <- file.path(folder, "records", "a b.json")
  on_current(desk, undo_review)
  writeLines(sub("\"mesh\": \"[^\"]*\"", "\"mesh\": \"other\"", readLines(record)), record)
  other <- fit()
  expect_match(paste(other[[1]]$warnings, collapse = " "), "drawn by hand are left out")
})

test_that("specimens whose drawn curves differ are measured anew", {
  skip_without_futures()
  dir <- tempfile("out")
  on.exit(unlink(dir, recursive = TRUE))
  desk <- two_balls()
  for (name in c("a", "b", "c", "d")) desk <- place_at(desk, name)
  reason <- function(desk) {
    shapes <- fit_shapes(digitised_from(desk)$specimens, quad_scheme(), dir)
    status_of(shapes[[1]], "bottom")$reason
  }
  plain <- reason(desk)
  expect_match(reason(draw_at(desk, "bottom", c(0, -0.35, 1))), "drawn by hand")
  expect_identical(reason(desk), plain)
})

test_that("a record of another observer or specimen, in a file of the same name, is refused", {
  dir <- tempfile("desk")
  place_at(two_balls(dir), "a")
  record <- file.path(dir, "AB", "records", "one.json")
  writeLines(sub("\"observer\": \"AB\"", "\"observer\": \"ab\"", readLines(record)), record)
  expect_error(two_balls(dir), "that of one by ab", class = "crestline_desk_error")
  unlink(dir, recursive = TRUE)
})

test_that("landmarks that were missing on the desk and have been found since are found", {
  dir <- tempfile("desk")
  place_at(two_balls(dir), "a")
  again <- current_review(two_balls(dir, blank = FALSE))
  expect_identical(again$state, c(a = "placed", b = "given", c = "given", d = "given"))
  expect_false(anyNA(again$specimen$landmarks))
  unlink(dir, recursive = TRUE)
})

test_that("found landmarks of a record give way to those that are found now, touched ones stay", {
  dir <- tempfile("desk")
  on.exit(unlink(dir, recursive = TRUE))
  place_at(two_balls(dir, blank = FALSE), "a")
  moved <- quad_specimen()
  moved$landmarks["b", ] <- moved$landmarks["b", ] + c(0, 3, 0)
  again <- current_review(desk_from(desk_sources(list(one = moved)), quad_scheme(), dir, "AB",
                                    FALSE, ridge_settings(error = FALSE), review_settings()))
  expect_identical(again$specimen$landmarks["b", ], moved$landmarks["b", ])
  expect_identical(again$state, c(a = "placed", b = "given", c = "given", d = "given"))
  record <- read_record(file.path(dir, "AB", "records", "one.json"))$landmarks
  expect_equal(unname(again$specimen$landmarks["a", ]), unlist(record[1, c("x", "y", "z")]),
               ignore_attr = TRUE)
  # Without any landmark of its own the specimen gets those of the record
  bare <- current_review(two_balls(dir))
  expect_false(anyNA(bare$specimen$landmarks))
})

test_that("a step that cannot be written is said", {
  dir <- tempfile("desk")
  desk <- place_at(two_balls(dir), "a")
  record <- file.path(dir, "AB", "records", "one.json")
  unlink(record)
  dir.create(file.path(record, "taken"), recursive = TRUE)
  after <- place_at(desk, "b")
  expect_match(current_review(after)$said, "not written: .*record cannot be written")
  expect_equal(current_review(after)$state[["b"]], "placed")
  unlink(record, recursive = TRUE)
  place_at(after, "c")
  expect_equal(sum(read_digitised(dir)$marks$state == "placed"), 3)
  unlink(dir, recursive = TRUE)
})

test_that("a record of another mesh is refused", {
  dir <- tempfile("desk")
  place_at(two_balls(dir), "a")
  record <- file.path(dir, "AB", "records", "one.json")
  writeLines(sub("\"mesh\": \"[^\"]*\"", "\"mesh\": \"other\"", readLines(record)), record)
  expect_crestline_error(two_balls(dir), "another mesh")
  expect_error(two_balls(dir), class = "crestline_desk_error")
  unlink(dir, recursive = TRUE)
})

test_that("two observers make a table, an array for geomorph and repeatability()", {
  dir <- tempfile("desk")
  for (who in c("AB", "C/D")) {
    desk <- two_balls(dir, who)
    for (i in 1:2) {
      for (name in c("a", "b", "c", "d")) desk <- place_at(desk, name)
      desk <- draw_at(desk, "bottom", c(0, -0.35, 1))
      if (i == 1) desk <- turn_to(desk, 1)
    }
  }
  both <- read_digitised(dir)
  expect_s3_class(both, "digitised")
  expect_output(print(both), "2 specimens, 2 observers")
  expect_output(print(both), "one by AB: 4 of 4 landmarks, 1 curve drawn (0 snapped)", fixed = TRUE)
  array <- as.array(both)
  expect_equal(dim(array), c(11, 3, 4))
  expect_equal(dimnames(array)[[3]], c("one AB", "two AB", "one C/D", "two C/D"))
  own <- digitised_from(desk)
  expect_equal(array[, , c("one C/D", "two C/D")], as.array(own), tolerance = 1e-12,
               ignore_attr = TRUE)
  expect_equal(unname(array[c("a", "b", "c", "d"), , "one AB"]), unname(quad_corners()),
               tolerance = 1e-3)
  expect_equal(nrow(as.data.frame(both)), 44)
  expect_setequal(both$marks$action, c("placed", "point set"))
  step <- both$steps[both$steps$specimen == "two" & both$steps$part == "c", ]
  expect_identical(both$marks$time[both$marks$specimen == "two" & both$marks$part == "c"],
                   step$time)
  expect_equal(table(both$steps$action)[["placed"]], 16)
  who <- unique(both$marks[c("specimen", "observer")])
  of <- function(column) stats::setNames(who[[column]], paste(who$specimen, who$observer))
  agreed <- repeatability(as.array(both, "landmarks"), of("specimen"), of("observer"),
                          "landmarks")
  expect_lt(max(agreed$parts$error), 1e-6)
  expect_equal(names(own$specimens), c("one", "two"))
  shape <- fit_shape(own$specimens$two, quad_scheme(), progress = FALSE)
  expect_match(status_of(shape, "bottom")$reason, "drawn by hand (C/D", fixed = TRUE)
  expect_identical(read_digitised(dir, "AB")$marks$observer, rep("AB", 22))
  expect_crestline_error(as.array(both, "surface"), "level")
  unlink(file.path(dir, "AB", "two.csv"))
  expect_error(read_digitised(dir), "table of its curves", class = "crestline_desk_error")
  expect_crestline_error(read_digitised(tempdir(check = TRUE), "nobody"), "no records")
  unlink(dir, recursive = TRUE)
})

test_that("finished specimens come back without being shown, from the desk and from its folder", {
  dir <- tempfile("desk")
  on.exit(unlink(dir, recursive = TRUE))
  desk <- two_balls(dir)
  for (name in c("a", "b", "c")) desk <- place_at(desk, name)
  desk <- draw_at(desk, "bottom", c(0, -0.35, 1))
  desk <- turn_to(desk, 1)
  for (name in c("a", "b", "c", "d")) desk <- place_at(desk, name)
  all <- digitised_from(desk)
  report <- all$specimens$one$report
  expect_identical(as.integer(report$count[report$check == "landmarks missing"]), 1L)
  expect_match(report$action[report$check == "landmarks missing"], "kept as missing: d")
  # The next day only the first is shown, and it is not touched
  again <- digitised_from(with_recorded_reviews(two_balls(dir), dir))
  expect_equal(again$marks, all$marks)
  expect_equal(again$steps, all$steps, ignore_attr = TRUE)
  expect_named(again$specimens, c("one", "two"))
  for (id in c("one", "two")) {
    expect_equal(again$specimens[[id]]$landmarks, all$specimens[[id]]$landmarks)
    expect_equal(again$specimens[[id]]$drawn, all$specimens[[id]]$drawn)
  }
  meshes <- list(one = quad_specimen(), two = desk$reviews$two$specimen)
  read <- read_digitised(dir, specimens = meshes, scheme = quad_scheme())
  expect_named(read$specimens, c("one", "two"))
  expect_equal(read$specimens$one$drawn, all$specimens$one$drawn)
  expect_equal(read$specimens$two$landmarks, all$specimens$two$landmarks)
  expect_identical(is.na(read$specimens$one$landmarks["d", 1]), TRUE)
  place_at(two_balls(dir, "CD"), "a")
  expect_message(both <- read_digitised(dir, specimens = c(meshes["one"], other = meshes["two"]),
                                        scheme = quad_scheme()), "no record .*: other")
  expect_named(both$specimens, c("one AB", "one CD"))
  expect_length(read_digitised(dir)$specimens, 0)
  # Of one without its mesh the rest is still there
  record <- file.path(dir, "AB", "records", "two.json")
  writeLines(sub("\"mesh\": \"[^\"]*\"", "\"mesh\": \"other\"", readLines(record)), record)
  expect_warning(left <- with_recorded_reviews(two_balls(dir), dir), "two.*left out.*another mesh",
                 class = "crestline_desk_warning")
  expect_named(digitised_from(left)$specimens, "one")
  expect_crestline_error(read_digitised(dir, "AB", meshes["two"], quad_scheme()), "mesh")
})

test_that("specimens of a desk have names of their own", {
  expect_named(desk_sources(c("x/face.ply", "b.obj")), c("face", "b"))
  expect_named(desk_sources(list(quad_specimen(), other = ball_mesh(), ball_mesh())),
               c("quad", "other", "specimen 3"))
  expect_crestline_error(desk_sources(c("x/a.ply", "y/a.ply")), "two named a")
  expect_crestline_error(desk_sources(list()), "specimens")
  skip_if_not_installed("shiny")
  expect_crestline_error(digitise(list(ball_mesh()), dir = tempdir()), "observer")
})

test_that("on the page clicks draw a line, keys choose, and the next specimen is shown", {
  skip_if_not_installed("shiny")
  desk <- two_balls(blank = FALSE)
  server <- desk_server(desk, desk_surfaces("plain", review_settings(radius = 20)), identity)
  shiny::testServer(server, {
    now <- function() current_review(review())
    ray <- function(at) {
      frame <- scene_frame(now()$specimen$mesh)
      ends <- into_scene(rbind(9 * at, at / 1e3), frame)
      list(from = as.list(ends[1, ]), towards = as.list(ends[2, ]))
    }
    session$setInputs(ready = 1)
    session$setInputs(curve = "bottom")
    session$setInputs(ray = ray(c(0, -25, 50)))
    expect_equal(nrow(now()$drawn$bottom$knots), 1)
    expect_match(output$chosen$html, "1 point, ")
    expect_match(output$list$html, "point set by AB")
    session$setInputs(drop = list(name = "1", ray = ray(c(0, -35, 50))))
    expect_equal(nrow(now()$drawn$bottom$knots), 1)
    expect_length(review_balls(now(), scene_frame(now()$specimen$mesh)), 1)
    session$setInputs(snap = 1)
    expect_match(now()$said, "plane cut")
    session$setInputs(ray = ray(now()$drawn$bottom$knots[1, 1:3]))
    expect_length(now()$drawn, 0)
    session$setInputs(undo = 1)
    session$setInputs(following = 1)
    expect_equal(review()$at, "two")
    session$setInputs(ready = 2, choose = 1)
    expect_equal(now()$selected, "a")
    expect_match(output$desk$html, "2 of 2: two")
    session$setInputs(previous = 1)
    expect_length(now()$drawn, 1)
  })
})

test_that("sides are the subject's own", {
  review <- begin_review(specimen(humface_scan(), humface_landmarks()), face_scheme(), 0.5,
                         ridge_settings(error = FALSE), 0.2, 1)
  expect_match(side_words(review, "chL", "landmarks"), "own left: .* right of the picture")
  expect_match(side_words(review, "enR", "landmarks"), "own right: .* left of the picture")
  expect_null(side_words(review, "pn", "landmarks"))
  expect_match(side_words(review, "nasal root left", "curves"), "own left")
  skip_if_not_installed("shiny")
  expect_match(as.character(chosen_html(select_landmark(review, "chL"))), "subject's own left")
})

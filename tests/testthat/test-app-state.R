# A folder of eight balls with landmarks beside them, one damaged, two groups, and a scheme.
ball_folder <- function() {
  dir <- tempfile("scans")
  dir.create(dir)
  for (i in 1:8) {
    stretch <- c(1 + 0.02 * i, 1, if (i %% 2) 1 else 1.2)
    mesh <- quad_specimen()$mesh
    mesh$vb[1:3, ] <- mesh$vb[1:3, ] * stretch
    name <- file.path(dir, sprintf("ball%d", i))
    write_mesh(structure(mesh[c("vb", "it")], class = "mesh3d"), paste0(name, ".ply"))
    write_landmarks(sweep(quad_corners(), 2, stretch, `*`), paste0(name, ".csv"))
  }
  writeLines("ply", file.path(dir, "ball8.ply"))
  groups <- data.frame(id = sprintf("ball%d", 1:8), group = c("a", "b"))
  dir.create(file.path(dir, "tables"))
  utils::write.csv(groups, file.path(dir, "tables", "groups.csv"), row.names = FALSE)
  write_scheme(quad_scheme(), file.path(dir, "scheme"))
  dir
}

app_form <- function(dir) {
  list(folder = dir, scheme = file.path(dir, "scheme"), observer = "me", errors = FALSE,
       table = file.path(dir, "tables", "groups.csv"), id = "id", by = "group", level = "curves",
       permutations = 99, seed = 1)
}

test_that("steps are the code that is shown, which runs again to the same numbers", {
  skip_if_not_installed("future")
  skip_if_not_installed("progressr")
  skip_if_not_installed("htmltools")
  dir <- ball_folder()
  form <- app_form(dir)
  state <- begin_app()
  for (name in c("folder", "beside", "measure", "quality", "homologise", "groups", "compare")) {
    state <- do_step(state, name, form)
    expect_false(state$failed, label = paste(name, paste(state$told, collapse = " ")))
    if (name == "measure") expect_match(state$shown, "ball8", all = FALSE)
  }
  expect_equal(state$steps[7], "compare")
  expect_length(state$values$sample, 7)
  expect_true(file.exists(file.path(dir, "output", "quality.html")))
  expect_false(do_step(state, "exports", form)$failed)
  # Another folder: nothing of the former one is compared, or written
  moved <- do_step(state, "folder", form)
  for (name in c("measure", "homologise", "compare", "exports")) {
    expect_match(do_step(moved, name, form)$told, "This step needs")
  }
  unlink(file.path(dir, "output"), recursive = TRUE)
  again <- new.env(parent = app_parent())
  lines <- state$code[-1]
  utils::capture.output(suppressMessages(suppressWarnings(
    for (line in lines) eval(parse(text = line), again)
  )))
  expect_identical(again$compared$tests, state$values$compared$tests)
  expect_identical(as.array(again$sample), as.array(state$values$sample))
  unlink(dir, recursive = TRUE)
})

test_that("a step that fails says so, and changes neither code nor values", {
  state <- begin_app()
  early <- do_step(state, "homologise", list())
  expect_true(early$failed)
  expect_match(early$told, "needs shapes")
  expect_identical(early$code, state$code)
  dir <- tempfile("empty")
  dir.create(dir)
  form <- c(app_form(dir)[c("folder", "errors", "observer")], scheme = "")
  state <- do_step(do_step(state, "folder", form), "find", form)
  expect_false(state$failed)
  lost <- do_step(state, "measure", form)
  expect_true(lost$failed)
  expect_identical(lost$code, state$code)
  expect_identical(ls(lost$values), ls(state$values))
  unlink(dir, recursive = TRUE)
})

test_that("text of the page is text in the code", {
  form <- list(folder = tempdir(), scheme = "", observer = "a\"); stop(\"b", table = "x\\y.csv",
               by = "g\"", id = "i", level = "curves", permutations = 999, seed = 2)
  for (name in names(app_needs())) {
    code <- step_code(name, form)
    expect_length(parse(text = code, keep.source = FALSE), length(code))
  }
  hand <- parse(text = step_code("hand", form)[1])[[1]]
  expect_identical(utils::URLdecode(hand[[3]][[4]]), form$observer)
  expect_setequal(names(app_needs()), names(app_titles()))
})

test_that("records of a desk are landmarks of the next measuring", {
  skip_if_not_installed("future")
  skip_if_not_installed("progressr")
  dir <- ball_folder()
  form <- app_form(dir)
  state <- do_step(begin_app(), "folder", form)
  wanted <- app_desk(state)
  expect_true(wanted$blank)
  desk <- desk_from(desk_sources(wanted$sources), state$values$scheme, file.path(dir, "desk"),
                    "me", FALSE, ridge_settings(error = FALSE), review_settings())
  for (i in 1:2) {
    desk <- on_current(desk, function(now) {
      place_selected(select_landmark(now, "a"), found_landmark(now$specimen, "a"))
    })
    if (i == 1) desk <- turn_to(desk, 1)
  }
  state <- do_step(state, "hand", form)
  expect_false(state$failed)
  expect_match(state$code, "desk", all = FALSE)
  state$values$files <- state$values$files[1:2]
  state <- do_step(state, "measure", form)
  expect_false(state$failed)
  expect_length(Filter(Negate(is.null), as.list(state$values$shapes)), 2)
  expect_false(app_desk(state)$blank)
  last <- begin_desk(paste0("ball", 7:8), desk$open)
  passed <- turn_to(last, 1)
  expect_equal(passed$at, "ball7")
  expect_match(current_review(passed)$said, "ball8 cannot be shown: ")
  unlink(dir, recursive = TRUE)
})

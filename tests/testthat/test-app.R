test_that("the app refuses wrong arguments", {
  skip_if_not_installed("shiny")
  expect_crestline_error(crestline_app(1), "dir")
  expect_crestline_error(crestline_app(port = 0), "port")
  expect_crestline_error(crestline_app(host = "0.0.0.0"), "host")
})

test_that("the page has a button for each step, and its server does them", {
  skip_if_not_installed("shiny")
  html <- as.character(app_page("scans"))
  steps <- paste0("step_", setdiff(names(app_needs()), "hand"))
  for (id in c(steps, "desk", "save", "done", "code", "folder", "observer", "table")) {
    expect_match(html, sprintf("id=\"%s\"", id))
  }
  dir <- tempfile("scans")
  dir.create(dir)
  shiny::testServer(app_server(begin_app()), {
    session$setInputs(folder = dir, scheme = "", observer = "me", save = 1)
    expect_match(output$told$html, "Look at a folder")
    session$setInputs(desk = 1)
    expect_match(output$told$html, "not done")
    session$setInputs(step_folder = 1)
    expect_match(output$code, "list.files", fixed = TRUE)
    expect_match(output$told$html, "done")
    session$setInputs(step_homologise = 1)
    expect_match(output$told$html, "needs shapes")
    session$setInputs(save = 2)
    expect_true(file.exists(file.path(dir, "output", "analysis.R")))
    expect_match(output$told$html, "Saved")
  })
  unlink(dir, recursive = TRUE)
})

test_that("clicks and forms build a scheme; it comes back with its specimen", {
  skip_if_not_installed("shiny")
  bare <- specimen(quad_specimen()$mesh, id = "ball")
  begin <- begin_build(bare, NULL, list(ridge = ridge_settings(error = FALSE), bridge = 0.2,
                                        threads = 1L, radius = 20, name = "quad"))
  returned <- new.env()
  shown <- shown_surface(bare, "plain", 10, 60000)
  server <- scene_server(begin, build_answers(shown, "front"),
                         function(value) returned$value <- value)
  ray <- function(name) {
    at <- quad_corners()[name, ]
    ends <- into_scene(rbind(3 * at, at), scene_frame(bare$mesh))
    list(from = as.list(ends[1, ]), towards = as.list(ends[2, ]))
  }
  form <- list(kind = "plane", path = "plane", closed = FALSE, radius = 20, width = 20, points = 7)
  folder <- tempfile()
  shiny::testServer(server, {
    session$setInputs(ready = TRUE, snap = "surface", rows = 4, folder = folder)
    for (name in c("a", "b", "c", "d")) session$setInputs(mark = name, ray = ray(name))
    expect_equal(build_names(review()), c("a", "b", "c", "d"))
    # A click on a ball chooses, whatever the name in the field
    session$setInputs(ray = ray("a"))
    session$setInputs(ray = ray("b"))
    expect_equal(review()$chain, c("a", "b"))
    do.call(session$setInputs, c(form, curve_name = "bottom"))
    session$setInputs(join = 1)
    session$setInputs(select = "d")
    session$setInputs(select = "c")
    session$setInputs(curve_name = "top", join = 2)
    expect_equal(review()$curves$curve, c("bottom", "top"))
    session$setInputs(curve_a = "bottom", curve_b = "top", patch_name = "mid", bound = 1)
    expect_equal(nrow(review()$surface$mid$points), 28)
    session$setInputs(drop = list(name = "c", ray = ray("b")))
    expect_equal(review()$specimen$landmarks["c", ], review()$specimen$landmarks["b", ],
                 tolerance = 1e-6)
    session$setInputs(undo = 1)
    session$setInputs(drop = list(name = "c", ray = list(from = c(500, 0, 0),
                                                         towards = c(500, 0, 1))))
    expect_match(review()$said, "no surface")
    session$setInputs(join = 3)
    expect_match(output$said$html, "Fewer than two|long")
    session$setInputs(curve = "top")
    expect_match(output$list$html, "data-curve=\"top\"")
    expect_match(output$list$html, "patch of 28 points")
    expect_equal(build_sent(review())$curve$points, 7)
    expect_length(build_balls(review(), shown$frame), 4)
    session$setInputs(save = 1)
    session$setInputs(done = 1)
    session$setInputs(cancel = 1)
  })
  expect_equal(read_scheme(folder)$curves$curve, c("bottom", "top"))
  expect_s3_class(returned$value$scheme, "curve_scheme")
  expect_equal(max(abs(returned$value$specimen$landmarks - quad_corners())), 0, tolerance = 0.1)
  unlink(folder, recursive = TRUE)
  shiny::testServer(server, session$setInputs(cancel = 1))
  expect_equal(build_names(list(specimen = returned$value$specimen)), character())
  expect_null(returned$value$scheme)
})

test_that("a click takes a suggestion where it meets one", {
  ball <- ball_mesh(4)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * c(50, 30, 25)
  state <- begin_build(specimen(structure(ball[c("vb", "it")], class = "mesh3d")), NULL,
                       list(ridge = ridge_settings(), bridge = 0.2, threads = 1L, radius = 12,
                            name = "egg"))
  state <- suggest_marks(state)
  expect_true("suggestion cap1" %in% names(build_items(state)))
  cap <- unlist(as.data.frame(state$suggested)[1, c("x", "y", "z")])
  after <- click_build(state, rbind(3 * cap, cap + c(0, 0.05, 0)), "tip", "surface")
  expect_equal(unname(after$specimen$landmarks["tip", ]), unname(cap), tolerance = 1e-9)
  beside <- click_build(state, rbind(c(0, 0, 90), c(0, 0, 25)), "top", "surface")
  expect_equal(unname(beside$specimen$landmarks["top", ]), c(0, 0, 25), tolerance = 1e-2)
  expect_identical(click_build(state, rbind(c(0, 200, 90), c(0, 200, 0)), "no", "surface"), state)
})

test_that("the page has what its script and its server look for", {
  skip_if_not_installed("shiny")
  html <- as.character(build_page("Scheme of <a>", list(radius = 4, points = 15, dir = "x")))
  for (id in c("face", "said", "chain", "list", "mark", "snap", "rename", "remove_mark", "suggest",
               "curve_name", "kind", "path", "closed", "radius", "width", "points", "join", "clear",
               "remove_curve", "patch_name", "curve_a", "curve_b", "rows", "bound", "remove_patch",
               "folder", "pairs", "save", "undo", "cancel", "done")) {
    expect_match(html, sprintf('id="%s"', id))
  }
  expect_match(html, "Scheme of &lt;a&gt;")
  expect_lt(sum(file.size(list.files(system.file("builder", package = "crestline"),
                                     full.names = TRUE))), 2e4)
})

test_that("what a page cannot be made of is refused", {
  skip_if_not_installed("shiny")
  expect_crestline_error(build_scheme(list()), "mesh")
  expect_crestline_error(build_scheme(ball_mesh(), scheme = 1), "scheme")
  expect_crestline_error(build_scheme(ball_mesh(), radius = 90), "radius")
  expect_crestline_error(build_scheme(ball_mesh(), prot = 1), c("prot", "port"))
})

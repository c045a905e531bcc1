test_that("the surface shown is thinned, in the scan's colours, alike in every unit and place", {
  face <- specimen(humface_scan())
  face$mesh$material$color <- ifelse(face$mesh$vb[2, ] > mean(face$mesh$vb[2, ]),
                                     "#FF0000", "#0000FF")
  whole <- shown_surface(face, "natural", 10, 60000)
  expect_identical(whole$mesh$it, face$mesh$it)
  expect_identical(whole$colour, face$mesh$material$color)
  expect_equal(from_scene(t(whole$mesh$vb[1:3, ]), whole$frame), t(face$mesh$vb[1:3, ]))
  expect_equal(mesh_diagonal(whole$mesh), 200)
  thin <- shown_surface(face, "natural", 10, 4000)
  expect_lte(ncol(thin$mesh$it), 4000)
  back <- from_scene(t(thin$mesh$vb[1:3, ]), thin$frame)
  expect_equal(thin$colour == "#FF0000", back[, 2] > mean(face$mesh$vb[2, ]))
  expect_lt(max(row_lengths(as.matrix(surface_points(face$mesh, back)[1:3]) - back)), 2)
  face$mesh$vb[1:3, ] <- face$mesh$vb[1:3, ] / 1000 + 70
  expect_equal(shown_surface(face, "natural", 10, 4000)$mesh$vb, thin$mesh$vb, tolerance = 1e-5)
})

test_that("only what has changed is drawn again", {
  review <- begin_review(quad_specimen(), quad_scheme(), 0.5, ridge_settings(error = FALSE), 0.2, 1)
  review$fitting <- refit_curves(review$fitting, review$specimen)
  scene <- open_scene(shown_surface(review$specimen, "plain", 10, 60000), "front")
  on.exit(rgl::close3d(scene$device))
  first <- redraw(scene, list(), review_items(review))
  expect_length(first$drawn, 8)
  expect_null(first$delete)
  expect_equal(sum(rgl::ids3d()$type == "linestrip"), 4)
  same <- redraw(scene, first$drawn, review_items(review))
  expect_length(c(same$delete, same$add), 0)
  moved <- place_selected(select_landmark(review, "b"),
                          surface_points(review$specimen$mesh, matrix(c(30, 0, 40), 1)))
  second <- redraw(scene, first$drawn, review_items(moved))
  expect_setequal(second$delete,
                  unlist(lapply(first$drawn[c("landmark b", "curve bottom", "curve right")],
                                `[[`, "ids")))
  expect_false(any(second$delete %in% rgl::ids3d()$id))
  gone <- redraw(scene, second$drawn, review_items(place_selected(moved, NULL)))
  expect_length(gone$drawn, 5)
  expect_length(gone$add, 0)
})

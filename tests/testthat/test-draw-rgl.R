test_that("the rgl engine draws into the null device and returns ids", {
  with_null_rgl({
    scene <- draw_surface(unit_ball(), view = "left", engine = "rgl")
    expect_length(scene$ids, 1)
    expect_equal(rgl::par3d("userMatrix")[1:3, 1:3], view_rotation("left"), tolerance = 1e-6)
    scene <- draw_lines(scene, cbind(0, 0, c(1, 2)))
    scene <- draw_points(scene, cbind(0, 0, 1), labels = "top")
    scene <- draw_band(scene, cbind(0:1, 0, 1), cbind(0:1, 1, 1))
    expect_equal(rgl::ids3d()$id, scene$ids)
    expect_equal(as.character(rgl::ids3d()$type),
                 c("triangles", "linestrip", "spheres", "text", "quads"))
    expect_output(print(scene), "5 objects")
  })
})

test_that("a specimen and its curve are drawn by rgl", {
  with_null_rgl({
    scene <- plot(ball_specimen(), "shape index", ball_curvature(), engine = "rgl", labels = TRUE)
    expect_equal(as.character(rgl::ids3d()$type), c("triangles", "spheres", "text"))
    rgl::clear3d()
    scene <- plot(equator_curve(), ball_specimen(), "plain", engine = "rgl")
    expect_setequal(as.character(rgl::ids3d()$type),
                    c("triangles", "quads", "linestrip", "spheres"))
  })
})

# Mean shapes laid over each other: two surfaces, transparent, or points and curves.

plot_means <- function(x, level, colour, engine, view, legend, main, ..., opacity = 0.8) {
  aligned <- x$aligned[[level]]
  view <- posed_view(view, aligned$mean)
  size <- if (isFALSE(aligned$scale)) 1 else mean(aligned$size)
  means <- lapply(stats::setNames(nm = levels(x$group)),
                  function(g) size * mean_shape_of(aligned, x$group == g))
  test <- intersect(c("mean shape", "mean shape F"), x$tests$test)
  words <- c(sprintf("mean shapes (%s)", level), p_value_of(x, level, c(test, NA)[1]))
  title <- if (is.null(main)) paste(words, collapse = ", ") else main
  if (is.null(aligned$triangles)) {
    draw <- if (engine == "widget") configurations_scene else plot_configurations
    return(draw(means, aligned$level, colour, view, legend, title))
  }
  meshes <- lapply(means, points_mesh, aligned$triangles)
  if (engine == "rgl") return(rgl_overlay(meshes, colour, opacity, view, ...))
  if (engine == "widget") {
    scene <- widget_overlay(meshes, colour, opacity, view, ...)
    if (legend) draw_key(scene, stats::setNames(colour, names(meshes)))
    return(draw_title(scene, title))
  }
  old <- graphics::par(mar = c(0.5, 0.5, 2, 0.5))
  on.exit(graphics::par(old))
  scene <- picture_overlay(meshes, colour, opacity, view_rotation(view), settings_of(engine, ...))
  graphics::title(title, font.main = 1, cex.main = 1)
  if (legend) {
    words <- paste(names(meshes), "in front")
    on_scene(scene, graphics::legend(
      "bottomleft", words, fill = front_colours(colour, opacity), bty = "n", cex = 0.8
    ))
  }
  invisible(scene)
}

# The colour of a pixel where each surface is the nearer one.
front_colours <- function(colour, opacity) {
  rgb <- grDevices::col2rgb(colour)
  grDevices::rgb(t(round(opacity * rgb + (1 - opacity) * rgb[, 2:1])), maxColorValue = 255)
}

#' Both surfaces in one picture: of every pixel the nearer one has the greater share
#' @noRd
picture_overlay <- function(meshes, colour, opacity, rotation, settings) {
  frame <- picture_frame(
    rotation %*% do.call(cbind, lapply(meshes, function(mesh) mesh$vb[1:3, ])), settings
  )
  seen <- Map(function(mesh, colour) {
    turned <- rotation %*% mesh$vb[1:3, ]
    xyz <- rbind((turned[1, ] - frame$usr[1]) / frame$pixel,
                 (frame$usr[4] - turned[2, ]) / frame$pixel, turned[3, ])
    rgb <- shade_vertices(rep(colour, ncol(xyz)), rotation %*% mesh$normals[1:3, ], settings)
    cpp_render_mesh(xyz, rgb, mesh$it, frame$width, frame$height, settings$samples)
  }, meshes, colour)
  a <- seen[[1]]
  b <- seen[[2]]
  of_a <- ifelse(a$depth >= b$depth, opacity, 1 - opacity)
  of_a[a$rgba[, , 4] == 0] <- 0
  of_a[b$rgba[, , 4] == 0 & a$rgba[, , 4] > 0] <- 1
  out <- a$rgba
  for (channel in 1:3) out[, , channel] <- of_a * a$rgba[, ,
                                                         channel] + (1 - of_a) * b$rgba[, , channel]
  out[, , 4] <- pmax(a$rgba[, , 4], b$rgba[, , 4])
  raster <- out
  graphics::rasterImage(raster, frame$usr[1], frame$usr[4] - frame$height * frame$pixel,
                        frame$usr[1] + frame$width * frame$pixel,
                        frame$usr[4])
  depth <- pmax(seen[[1]]$depth, seen[[2]]$depth)
  structure(list(rotation = rotation, pixel = frame$pixel, depth = depth, usr = frame$usr,
                 plt = graphics::par("plt"),
                 tolerance = settings$tolerance * mesh_diagonal(meshes[[1]])),
            class = "picture_scene")
}

#' Both surfaces as layers of one scene
#' @noRd
widget_overlay <- function(meshes, colour, opacity, view, ...) {
  all <- do.call(rbind, lapply(meshes, function(mesh) t(mesh$vb[1:3, ])))
  scene <- configuration_scene(list(all), view, list(...))
  for (i in seq_along(meshes)) {
    add_surface(in_layer(scene, names(meshes)[i]), meshes[[i]], colour[i], opacity)
  }
  scene
}

rgl_overlay <- function(meshes, colour, opacity, view, ...) {
  scene <- draw_surface(meshes[[1]], colour[1], view, "rgl", alpha = opacity, ...)
  second <- meshes[[2]]
  ids <- rgl::triangles3d(
    t(second$vb[1:3, ]), normals = t(second$normals[1:3, ]), indices = second$it, color = colour[2],
    alpha = opacity, specular = "#202020"
  )
  add_ids(scene, ids)
}

#' The p-value of a test as print() gives it: that of a single component is adjusted
#' @noRd
p_value_of <- function(x, level, test) {
  single <- grepl("^PC[0-9]+$", test)
  own <- x$tests[[if (isTRUE(single)) "p_adjusted" else "p_value"]]
  own <- own[which(x$tests$level == level & x$tests$test == test)]
  if (!length(own)) return(NULL)
  sprintf("%sp = %s", if (single) "adjusted " else "", format.pval(own, digits = 2, eps = 1e-4))
}

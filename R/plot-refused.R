# Objects that have no picture of their own: plot() names the picture to draw instead.

#' What to plot instead of an object, by class
#' @noRd
plotted_instead <- c(
  align_settings = "Plot the alignment: plot(align(sample)).",
  bending_energy = "Plot the shape itself: plot(shape), or draw_surface() for a mesh.",
  cohort_settings = "Plot specimens of the cohort: plot(specimen).",
  comparison_settings = "Plot a comparison: plot(compare_groups(sample, group)).",
  comparison_summary = "Plot the object that it summarises.",
  crestline_summary = "Plot the object that it summarises.",
  curvature = "Draw it as colours: draw_surface(mesh, surface_colours(mesh, value)).",
  curvature_surface = "Plot the curve that it belongs to: plot(curve, \"panel\").",
  curve_distance = "Plot the shapes: plot(shape).",
  curve_route = "Plot a curve that was found with it: plot(curve).",
  curve_scheme = "Plot a specimen or a shape of this scheme: plot(specimen), plot(shape).",
  digitised = "Plot one of its specimens: plot(digitised$specimens[[1]]).",
  find_settings = "Plot a specimen with the landmarks found: plot(find_landmarks(specimen)).",
  keep_away = "Plot the curve that was found with it: plot(curve).",
  keep_side = "Plot the curve that was found with it: plot(curve).",
  landmark_template = "Plot a specimen with the landmarks found: plot(find_landmarks(specimen)).",
  mesh_path = paste("Draw it on its mesh: scene <- draw_surface(mesh);",
                    "draw_lines(scene, path[c(\"x\", \"y\", \"z\")])."),
  model_settings = "Plot a model: plot(shape_lm(sample, formula, data)).",
  noise_settings = "Plot a curve that was found with the noise: plot(curve).",
  norm_settings = "Plot the sample of the norms: plot(sample).",
  norms_summary = "Plot the object that it summarises.",
  path_coordinates = "Plot the curve that was found in them: plot(curve, \"panel\").",
  path_settings = "Draw a path that was found with them on its mesh: draw_lines().",
  picture_scene = "It is drawn already; add to it by draw_lines() and draw_points().",
  population_settings = "Plot the simulated specimens: plot(faces$specimens[[1]]).",
  quality_limits = "Write a page of shapes with their grades: quality_report(shapes, file).",
  refine_settings = "Plot refined landmarks: plot(specimen, what = \"refinement\").",
  repeat_settings = "Plot the shapes of the two visits: plot(shape).",
  review_settings = "Plot the specimen: plot(specimen).",
  rgl_scene = "It is drawn already; add to it by draw_lines() and draw_points().",
  ridge_line = "Plot the curve that it belongs to: plot(curve, \"panel\").",
  ridge_settings = "Plot a curve that was found with them: plot(curve).",
  sample_files = "Plot the components of its alignment: plot(shape_pca(align(sample))).",
  sample_limits = "Plot the sample: plot(sample).",
  scan_noise = "Plot the specimen: plot(specimen).",
  shape_batch = "Plot one shape: plot(shapes[[1]]).",
  shape_norms = "Plot the sample that they were fitted to: plot(sample).",
  shape_quality = "Write a page of shapes with their grades: quality_report(shapes, file).",
  shape_settings = "Plot the shape: plot(shape, specimen).",
  simulated_cohort = "Plot one of its specimens: plot(specimen).",
  simulated_faces = "Plot the aligned points: plot(align(true_points(faces, points))).",
  slide_settings = "Plot the sample that was slid with them: plot(sample).",
  study_settings = "Plot columns of the study, a data frame.",
  summary_shape_pca = "Plot the components: plot(pca).",
  widget_scene = "Print it; add to it by draw_lines() and draw_points().",
  visit_errors = "Plot the shapes of the two visits: plot(shape).",
  visit_settings = "Plot the shapes of the two visits: plot(shape)."
)

#' @rawNamespace
#' S3method(plot,align_settings,refuse_plot)
#' S3method(plot,bending_energy,refuse_plot)
#' S3method(plot,cohort_settings,refuse_plot)
#' S3method(plot,comparison_settings,refuse_plot)
#' S3method(plot,comparison_summary,refuse_plot)
#' S3method(plot,crestline_summary,refuse_plot)
#' S3method(plot,curvature,refuse_plot)
#' S3method(plot,curvature_surface,refuse_plot)
#' S3method(plot,curve_distance,refuse_plot)
#' S3method(plot,curve_route,refuse_plot)
#' S3method(plot,curve_scheme,refuse_plot)
#' S3method(plot,digitised,refuse_plot)
#' S3method(plot,find_settings,refuse_plot)
#' S3method(plot,keep_away,refuse_plot)
#' S3method(plot,keep_side,refuse_plot)
#' S3method(plot,landmark_template,refuse_plot)
#' S3method(plot,mesh_path,refuse_plot)
#' S3method(plot,model_settings,refuse_plot)
#' S3method(plot,noise_settings,refuse_plot)
#' S3method(plot,norm_settings,refuse_plot)
#' S3method(plot,norms_summary,refuse_plot)
#' S3method(plot,path_coordinates,refuse_plot)
#' S3method(plot,path_settings,refuse_plot)
#' S3method(plot,picture_scene,refuse_plot)
#' S3method(plot,population_settings,refuse_plot)
#' S3method(plot,quality_limits,refuse_plot)
#' S3method(plot,refine_settings,refuse_plot)
#' S3method(plot,repeat_settings,refuse_plot)
#' S3method(plot,review_settings,refuse_plot)
#' S3method(plot,rgl_scene,refuse_plot)
#' S3method(plot,ridge_line,refuse_plot)
#' S3method(plot,ridge_settings,refuse_plot)
#' S3method(plot,sample_files,refuse_plot)
#' S3method(plot,sample_limits,refuse_plot)
#' S3method(plot,scan_noise,refuse_plot)
#' S3method(plot,shape_batch,refuse_plot)
#' S3method(plot,shape_norms,refuse_plot)
#' S3method(plot,shape_quality,refuse_plot)
#' S3method(plot,shape_settings,refuse_plot)
#' S3method(plot,simulated_cohort,refuse_plot)
#' S3method(plot,simulated_faces,refuse_plot)
#' S3method(plot,slide_settings,refuse_plot)
#' S3method(plot,study_settings,refuse_plot)
#' S3method(plot,widget_scene,refuse_plot)
#' S3method(plot,visit_errors,refuse_plot)
#' S3method(plot,visit_settings,refuse_plot)
#' S3method(plot,summary_shape_pca,refuse_plot)
#' @noRd
refuse_plot <- function(x, ...) {
  class <- intersect(class(x), names(plotted_instead))[1]
  crestline_abort(sprintf("a %s has no picture of its own.", class), plotted_instead[[class]],
                  stage = "picture", call = NULL)
}

#' crestline: ridge and valley curves of surfaces
#'
#' crestline finds ridge and valley curves (crest lines) of a triangulated surface between
#' landmarks. The curves become semilandmarks on the scan. Sliding semilandmarks and generalised
#' Procrustes analysis make a sample of them. Start with [read_specimen()] or [specimen()], look at
#' it with `plot()`, then [ridge_curve()]; [fit_shape()] measures a whole specimen.
#'
#' # Options
#' * `crestline.threads`: number of threads of the loops over vertices, 1 unless set.
#'
#' # Units
#' Every length is in the unit of the mesh (usually mm for faces). Curvatures and strengths are in 1
#' / that unit. Angles are in radians. The shape index, ratios of strengths and barycentric weights
#' have no unit.
#'
#' # Lifecycle
#' Functions are meant to stay as they are. Those that are *experimental* say so in their help:
#' simulation ([simulate_ridge()], [simulate_faces()], [simulate_cohort()]), norms
#' ([fit_norms()], [assess()]) and drawing step by step ([draw_surface()]).
#' Former names are in [crestline-deprecated].
#'
#' # Functions by task
#'
#' * *Read a scan*: [read_specimen()], [specimen()]; landmarks and curves: [read_landmarks()],
#'   [write_landmarks()], [read_curves()]; the source of each: `summary()`, see [provenance].
#' * *Get landmarks without hands*: [find_landmarks()], [check_placing()], [second_opinion()],
#'   [refine_landmarks()]; by hand, on a page: [place_landmarks()], [review_landmarks()]
#'   with [review_settings()]; several specimens, curves too: [digitise()], [read_digitised()]; a
#'   template of your own: [landmark_template()], [face_template()],
#'   [calibrate_template()], with [find_settings()] and [refine_settings()].
#' * *Curvature*: [curvature()], [shape_index()], [curvedness()], [shape_category()].
#' * *One curve*: [ridge_curve()] with [ridge_settings()], [curve_route()], [keep_away()],
#'   [keep_side()] and, for the noise of a scanner, [scan_noise()] with [noise_settings()]; its
#'   stages: [reference_path()] with [path_settings()], [path_coordinates()],
#'   [curvature_surface()], [ridge_line()], [lift()]; another path: [plane_path()].
#' * *Places on a mesh*: [locate()] (the closest one), [frechet_mean()].
#' * *A whole specimen*: [fit_shape()] by a scheme ([face_scheme()], [read_scheme()],
#'   [curve_scheme()], [write_scheme()], [learn_tracks()]) with [shape_settings()]; a scheme of your
#'   own: [build_scheme()] (a page), [suggest_landmarks()], [snap()], [check_scheme()]; its parts:
#'   [coords()], [shape_mesh()], [patch_mesh()], [write_mesh()], [write_glb()].
#' * *How far to trust it*: [quality()], [quality_report()], [quality_limits()],
#'   [surface_faults()].
#' * *Many specimens*: [fit_shapes()], [failures()], [warnings_of()], [read_batch()].
#' * *Sliding semilandmarks*: [homologise()], [slide()], [slide_settings()], [bending_energy()],
#'   [symmetrise()], [asymmetry()]; parts of a sample: [shape_sample]; a sample in files:
#'   [write_blocks()], [open_sample()], [write_parquet()].
#' * *Statistics*: generalised Procrustes analysis [align()], with warnings by [sample_limits()];
#'   principal components [shape_pca()], [shape_at()]; groups [compare_groups()], [shape_lda()];
#'   covariates and allometry [shape_lm()]; asymmetry [symmetry_parts()]; settings
#'   [align_settings()], [comparison_settings()], [model_settings()].
#' * *Other packages*: [as_geomorph()], [as_rrpp()], [as_morpho()], and back [as_aligned()]; files
#'   for MorphoJ and Morphologika [write_morphoj()], [write_morphologika()]; for 3D Slicer
#'   [write_slicer()]; meshes of MeshMonk [read_registered()], [carry_points()].
#' * *Agreement of two measurements*: [curve_distance()], [repeatability()].
#' * *Measurements*: [measurements()] of distances, angles, lengths, areas and volumes by a table
#'   such as [face_measurements()].
#' * *Norms by age and sex*: [fit_norms()] with [norm_settings()]; one face against them:
#'   [assess()], [plot.assessment()], its page [write_page()]; files: [write_norms()],
#'   [read_norms()].
#' * *Two visits of one person*: [compare_visits()] with [visit_settings()],
#'   [plot.visit_comparison()]; errors from repeated scans [visit_errors()] with
#'   [repeat_settings()].
#' * *Pictures*: [plot.specimen()], [plot.curve()], [plot_curves()], [plot.shape()],
#'   [plot.aligned()], [plot.group_comparison()], [plot.shape_pca()], [plot.shape_lm()],
#'   [plot.repeatability()]; colours [plot_shape_scale()], [shape_colours()].
#' * *Pictures for print*: [write_picture()].
#' * *Pages for the browser*: [write_page()], [write_pca_page()], [quality_report()].
#' * *From a shell, Python or Slicer*: [run_command()].
#' * *Without code*: [crestline_app()], the whole job on a page.
#' * *A picture step by step*: [draw_surface()], [draw_lines()], [draw_points()], [draw_band()],
#'   [visible_points()], [picture_settings()], [widget_settings()], [drawing_engine()].
#' * *Known truth*: [simulate_ridge()], [ridge_study()] with [study_settings()], [simulate_faces()]
#'   with [face_effect()], [population_settings()] and [scan_settings()], [true_points()],
#'   [true_effect()]; [simulate_cohort()] with [cohort_settings()].
#'
#' # Vignettes
#' `vignette(package = "crestline")` lists them. If the list is empty, the package was installed
#' without them; see the README.
#'
#' * `crestline`: ten minutes with one face, and your own data;
#' * `own-object`: a scheme for another object, by clicks and table by table;
#' * `without-landmarks`: from a raw scan to its landmarks, and how far to trust them;
#' * `many`: hundreds of scans on one core, several machines or in a queue;
#' * `homology`: which sliding of semilandmarks makes points homologous;
#' * `sexual-dimorphism`: two groups compared by landmarks, curves and surface;
#' * `designs`: which test for which design;
#' * `covariates`: size, age and other covariates;
#' * `norms`: from a sample to a reference by age and sex that can be shared;
#' * `visits`: one patient, two visits;
#' * `interop`: to geomorph, Morpho and RRPP, and back;
#' * `reach`: from Slicer, Python and the shell, and back;
#' * `method`: every equation beside the function that does it;
#' * `paper`: the paper, line by line, and what differs here;
#' * `how-good`: how near the curves come to ridges that are known;
#' * `curvature-bias`: bias and variance of curvature.
#'
#' # Glossary
#' *The scan and its landmarks*
#'
#' * **mesh**: a triangulated surface, a `mesh3d` of the packages rgl and Rvcg.
#' * **specimen**: a mesh that was checked, with its named landmarks and an id ([specimen()]).
#' * **landmark**: a named place on the mesh, put there by the user or by a search.
#' * **place**: a point on the mesh, given by its triangle (`face`) and three barycentric weights
#'   (`w1`, `w2`, `w3`); in a scheme, one or several points that coincide by construction.
#' * **placing**: the table with the state of each landmark ("found", "predicted", "absent",
#'   "placed") and its confidence ([find_landmarks()]).
#' * **confidence**: a number from 0 to 1 that falls when the evidence for a found landmark
#'   disagrees.
#' * **doubtful**: a found landmark with a confidence below 0.5, or a match whose score is poor
#'   ([check_placing()]).
#' * **predicted**: a landmark that is placed by the positions of the others, since the surface has
#'   no evidence for it.
#' * **definition**: a rule that gives the position of a landmark by curvature
#'   ([refine_landmarks()]). Examples are a cap, a cup, an extreme of a profile, and a crossing of
#'   curves.
#'
#' * **exchanged**: two landmarks each of which lies where the other belongs, such as left and
#'   right.
#' * **origin**: the source of each landmark: a file, given, found, predicted, placed or moved
#'   ([provenance]).
#' * **key**: a hash of a mesh's vertices and triangles. Results have the key of their mesh, and are
#'   refused with any other mesh.
#'
#' *Curvature*
#'
#' * **radius**: the size of the neighbourhood in which the curvature of a vertex is fitted
#'   ([curvature()]).
#' * **k1, k2**: the principal curvatures, k1 >= k2, positive where the surface bends towards its
#'   outward normal, so that a valley has k1 > 0 and a ridge k2 < 0.
#' * **shape index**: the kind of shape from -1 (cup) over 0 (saddle) to 1 (cap), independent of
#'   size ([shape_index()]).
#' * **strength**: the amount of the sought curvature at a place, in 1 / unit, and 0 where the
#'   surface has curvature of the other kind.
#' * **contrast**: mean strength along a curve over the mean strength beside it; 1 means that the
#'   curve is no stronger than its surroundings.
#'
#' *A curve*
#'
#' * **ridge, valley, plane**: the kinds of curve: along a crest, along a groove, or the shortest
#'   plane cut, which does not use curvature.
#' * **cut**: a path that a plane through both landmarks cuts from the mesh ([plane_path()]).
#' * **trimmed**: a curve of which the scheme keeps only the part next to one end (`cut_share`).
#' * **reference path**: the plane cut with the greatest mean strength, beside which the curve is
#'   sought ([reference_path()]).
#' * **rival**: another plane cut, elsewhere, that gathers nearly as much strength (`competing` is
#'   its criterion as a share of the chosen one's).
#' * **window**: the strip of the mesh within the half width `width` of the reference path, in which
#'   the curve may lie.
#' * **(s, d)**: arc length along the reference path and signed distance from it
#'   ([path_coordinates()]).
#' * **trust**: the part of the reference path in which curvature is used; elsewhere strength is 0.
#' * **se**: standard error of the curve's position across itself, if the mesh were scanned again
#'   with independent noise at each vertex.
#' * **determined**: whether curvature fixes the curve; if not, `reason` gives the cause.
#' * **pass**: one round of the estimate; a second pass takes the first curve as its reference path.
#'
#' *A shape*
#'
#' * **scheme**: the tables of landmarks, curves, patches and left-right pairs that one kind of
#'   object has ([curve_scheme()], [face_scheme()]).
#' * **shape**: one specimen measured by a scheme: its points, and a status for every part
#'   ([fit_shape()]).
#' * **level**: the kind of points: "landmarks", "curves" or "surface"; "model" is all three, each
#'   place once ([align()], [as_geomorph()]).
#' * **names of points**: a point of a curve is "curve point", such as "philtrum ridge left 3". A
#'   point of a patch is "patch column row", or "patch block column row" if the patch has blocks
#'   ([curve_scheme()]). Some curves and patches share a name; their level tells them apart.
#' * **part**: one landmark, curve or patch of a shape.
#' * **semilandmark**: one of a fixed number of points on a curve or patch. Its place along the
#'   curve or on the patch is not a measurement but a convention. Sliding makes it comparable
#'   between specimens.
#' * **share**: a length as a fraction of another length (a path, a radius, the distance between two
#'   landmarks), without unit. `cut_share` gives the length of a trimmed curve.
#' * **track**: the whole curve on the mesh, with the arc length of each of its points, along which
#'   they can slide.
#' * **patch**: a piece of surface between curves, filled with semilandmarks.
#' * **column, row**: a column of a patch is a cut between two points of its bounding curves; its
#'   points are the rows.
#' * **strip**: triangles that join two patches which do not share a curve.
#' * **bridged**: led across a hole of the mesh by flat triangles; points there are missing.
#' * **spike**: a place where the mesh is crumpled: four triangles beside each other that are bent
#'   by more than 30 degrees ([quality_limits()]). A sharp fold, as of a lid, counts as one.
#' * **grade**: green (no doubt), amber (look at it) or red (do not use it as it is)
#'   ([quality()]).
#'
#' *A sample*
#'
#' * **homologous**: points of two specimens that are the same place of the object.
#' * **sliding semilandmarks**: semilandmarks that are moved along their curve or over the mesh
#'   until the bending energy from a template is least ([slide()]).
#' * **template**: the shape that others are slid against ([homologise()] uses the sample's own
#'   mean); for [find_landmarks()], a surface whose landmarks are carried to a scan
#'   ([landmark_template()]).
#' * **bending energy**: the bending of the thin-plate spline from the template to a specimen
#'   ([bending_energy()]).
#' * **nugget**: the tolerance of the spline at a point. With a nugget an error of a point across
#'   its curve does not make it move along the curve.
#' * **strain**: a penalty on uneven spacing along a curve.
#' * **sample**: the shapes of many specimens with homologous points ([homologise()]).
#' * **aligned**: a sample after generalised Procrustes analysis: centred, scaled and turned onto
#'   its mean ([align()]).
#' * **estimated**: a missing point of a specimen that [align()] places by the other points.
#' * **provenance**: the record of a result's origin: version, scheme, mesh, landmarks and settings
#'   ([provenance]).
#'
#' @references
#' Vittert, L., Bowman, A. W. and Katina, S. (2019) A hierarchical curve-based
#' approach to the analysis of manifold data. *Annals of Applied Statistics*
#' 13(4), 2539-2563. \doi{10.1214/19-AOAS1267}. Called "the paper" in these pages;
#' its preprint is titled "Statistical models for manifold data with
#' applications to the human face".
#'
#' @keywords internal
#' @useDynLib crestline, .registration = TRUE
#' @importFrom Rcpp evalCpp
"_PACKAGE"

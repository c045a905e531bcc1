# Each landmark beside the place that its definition says.

#' Compare landmarks with their definitions by curvature
#'
#' Compares each landmark with the position that its definition by curvature gives. A definition is
#' the crossing of two curves, the place where a curve turns most or ends, the strongest cap or cup,
#' or an extreme of a profile. The search starts at the landmark, and its result does not otherwise
#' depend on the landmark. Two people whose landmarks differ a little therefore get the same place.
#' The value gives the distance by which each landmark would move. With `move` it is moved.
#'
#' By default nothing is moved. People often place a landmark where curvature has no extreme. On
#' faces, most definitions of [face_scheme()] lie 0.2 to 3 mm from the landmarks that people placed;
#' `vignette("without-landmarks", "crestline")` has the figures. Moving shifts carefully placed
#' landmarks away from their intended position, in the same direction in every specimen. The
#' distance also serves as a flag. A landmark that is much farther from its defined place than in
#' other specimens was probably misplaced.
#'
#' Some definitions depend on other landmarks (the mirror plane of pairs, the ends of a curve). They
#' use the defined places of these landmarks, and are repeated until none changes.
#'
#' @param specimen A [specimen()] with landmarks.
#' @param scheme A [curve_scheme()] with a table of definitions, such as [face_scheme()].
#' @param move Landmarks that are moved: FALSE (none), TRUE (all), or their names.
#' @param settings Constants of the searches, as of [refine_settings()].
#' @param curvature Function of a radius that gives the [curvature()] of the specimen's mesh. It
#'   saves time for many sets of landmarks on one mesh. NULL: curvature is estimated.
#' @param unit As in [fit_shape()].
#' @param threads Number of threads of [curvature()].
#' @param ... Fields of [refine_settings()], the former form. They give a message of class
#'   `crestline_deprecated`.
#' @return The specimen with a field `refinement`. With `move`, its `landmarks` are moved, and their
#'   positions in `placing` too, if it has that field. Confidences are not changed. `refinement` is
#'   a data frame with a row for each definition; lengths are in the unit of the mesh:
#'   * `landmark`, `kind`;
#'   * `state`: "found"; "none" (not found, `reason` gives the cause); or "missing" (the specimen
#'     lacks the landmark, or one that the definition depends on);
#'   * `distance`: from the landmark to its defined place;
#'   * `value`: the extreme curvature at that place (NA for a crossing);
#'   * `moved`: TRUE if the landmark was moved;
#'   * `given_x`, `given_y`, `given_z`: the original position of the landmark;
#'   * `x`, `y`, `z`, `face`, `w1`, `w2`, `w3`: the defined place, on the mesh;
#'   * `reason`.
#' @section Errors: of class `crestline_error`: the scheme has no definitions, the specimen has none
#'   of their landmarks, or `move` names other landmarks.
#' @template glossary
#' @templateVar where sections 1 and 7
#' @template paper
#' @details The paper proposes crossings of curves and places of extreme geodesic curvature. Ends of
#'   curves, caps, cups and extremes of a profile are added here.
#' @seealso [curve_scheme()], [find_landmarks()]
#' @examples
#' data(humface, package = "Rvcg")
#' file <- system.file("extdata", "humface_landmarks.csv", package = "crestline")
#' face <- specimen(humface, read_landmarks(file), id = "humface")
#' face <- refine_landmarks(face, face_scheme())
#' face$refinement[c("landmark", "kind", "state", "distance")]
#' moved <- refine_landmarks(face, face_scheme(), move = c("chL", "chR"))
#' @export
refine_landmarks <- function(specimen, scheme, move = FALSE, settings = refine_settings(),
                             curvature = NULL, unit = NULL,
                             threads = getOption("crestline.threads", 1L), ...) {
  check_given()
  check_class(specimen, "specimen", "specimen", "specimen() or read_specimen()")
  check_class(settings, "refine_settings", "settings", "refine_settings()")
  settings <- settings_with_former(settings, "refine_settings", ...)
  if (!is.null(curvature)) check_function(curvature, "curvature")
  threads <- check_threads(threads)
  definitions <- definitions_of(scheme, specimen, unit)
  move <- check_move(move, definitions$landmark)
  specimen$refinement <- NULL
  curvature <- curvature_by_radius(specimen, curvature, settings$order, threads)
  pairs <- scheme$pairs[scheme$pairs$level == "landmarks", ]
  settings$ridge <- ridge_settings(error = FALSE)
  places <- refined_places(specimen, definitions, pairs, curvature, settings)
  refinement <- refinement_table(specimen, definitions, places)
  refinement$moved <- refinement$state == "found" & refinement$landmark %in% move
  for (i in which(refinement$moved)) {
    specimen <- with_landmark_at(specimen, refinement$landmark[i], refinement[i, mesh_columns])
    if (!is.null(specimen$placing)) {
      # The same table with the place of a landmark that a definition moved; its confidence stays
      placing <- specimen$placing
      row <- match(refinement$landmark[i], placing$landmark)
      if (!is.na(row)) placing[row, c("x", "y", "z")] <- refinement[i, c("x", "y", "z")]
      specimen$placing <- placing
    }
  }
  specimen$refinement <- refinement
  with_origin(specimen, refinement$landmark[refinement$moved], "defined")
}

#' Settings of refine_landmarks()
#'
#' The constants of the searches of [refine_landmarks()].
#'
#' @template setting-names
#' @param window Half width of the local fits that locate a peak between vertices, as a share of the
#'   radius. It is wider if the vertices are far apart.
#' @param apart Distance within which only the highest of several peaks is tried, as a share of the
#'   radius.
#' @param faint Peaks of curvature below this value times 1 / radius are ignored (no unit).
#' @param share A ridge ends where its strength has fallen to this share of its maximum.
#' @param order Order of the curvature fits, see [curvature()].
#' @param tolerance Definitions that depend on other landmarks are repeated until none moves by more
#'   than this share of the radius.
#' @param rounds Greatest number of repetitions, see `tolerance`.
#' @return List of class `refine_settings`.
#' @section Errors: of class `crestline_error`: a name is not that of a setting, or a value is out
#'   of range.
#' @template glossary
#' @examples
#' refine_settings(window = 1)
#' @export
refine_settings <- function(..., window = 0.75, apart = 0.5, faint = 0.05, share = 0.5,
                            order = "adaptive cubic", tolerance = 1e-3, rounds = 10) {
  new_settings("refine_settings", check_refine_settings, list(...))
}

check_refine_settings <- function(settings) {
  check_number(settings$window, "window", 0, open = TRUE)
  check_number(settings$apart, "apart", 0)
  check_number(settings$faint, "faint", 0)
  check_number(settings$share, "share", 0, 1, open = TRUE)
  settings$order <- check_order(settings$order)
  check_number(settings$tolerance, "tolerance", 0)
  settings$rounds <- check_count(settings$rounds, "rounds")
  settings
}

#' @export
print.refine_settings <- function(x, ...) {
  check_method_dots(...)
  print_settings(x, "<refine_settings> of refine_landmarks()")
}

definitions_of <- function(scheme, specimen, unit) {
  check_class(scheme, "curve_scheme", "scheme", "curve_scheme() or face_scheme()")
  scheme <- scheme_in_unit(scheme, unit, specimen)
  definitions <- scheme$definitions
  if (!NROW(definitions)) {
    crestline_abort(sprintf("the scheme %s has no definitions of landmarks.", scheme$name),
                    "Give curve_scheme() a table `definitions`.", stage = "scheme")
  }
  if (!any(definitions$landmark %in% rownames(specimen$landmarks))) {
    refuse_landmarks(sprintf("it has none of the landmarks that %s defines.", scheme$name),
                     near_names(definitions$landmark[1], rownames(specimen$landmarks)), specimen$id)
  }
  check_scale(specimen, scheme, unit)
  definitions
}

check_move <- function(move, names) {
  if (isTRUE(move)) return(names)
  if (isFALSE(move)) return(character())
  wrong <- if (is.character(move)) setdiff(move, names) else describe_value(move)
  if (length(wrong)) {
    crestline_abort(sprintf("`move` is %s.", shorten(wrong)),
                    sprintf("Give TRUE, FALSE or some of %s.", shorten(names, 30)),
                    stage = "arguments")
  }
  move
}

#' Curvature sources of a specimen, one for each radius that is asked for
#' @param given Function of a radius, or NULL.
#' @noRd
curvature_by_radius <- function(specimen, given, order, threads) {
  force(given)
  known <- list()
  function(radius) {
    key <- format(radius, digits = 15)
    if (is.null(known[[key]])) {
      known[[key]] <<- known_curvature(
        if (!is.null(given)) given(radius), specimen, radius, threads, order
      )
    }
    known[[key]]
  }
}

#' The places of all definitions, taken again while those that they build on move
#' @return List with an entry for each definition: as of [defined_place()], with `point` (one row of
#'   [surface_points()]).
#' @noRd
refined_places <- function(specimen, definitions, pairs, curvature, settings) {
  given <- specimen$landmarks
  current <- with_located(specimen)
  # The landmarks that each definition builds on
  inputs <- lapply(seq_len(nrow(definitions)), function(i) {
    definition <- definitions[i, ]
    left <- if (!is.na(definition$mirror)) mirror_names(definition$mirror)
    names <- c(left, pairs$right[match(left, pairs$left)],
               unlist(definition[c("from", "to", "across_from", "across_to")]))
    unname(names[!is.na(names)])
  })
  places <- vector("list", nrow(definitions))
  seen <- vector("list", nrow(definitions))
  order <- order(lengths(inputs) > 0)
  for (round in seq_len(settings$rounds)) {
    settled <- TRUE
    for (i in order) {
      at <- landmarks_at(current, inputs[[i]])
      unmoved <- !is.null(seen[[i]]) &&
        (nrow(at) == 0 ||
           isTRUE(max(row_lengths(at - seen[[i]])) <= settings$tolerance * definitions$radius[i]))
      if (unmoved) next
      settled <- FALSE
      seen[[i]] <- at
      places[[i]] <- located_place(current, definitions[i, ], given, at, pairs, curvature, settings)
      point <- places[[i]]$point
      if (!is.null(point)) current <- with_landmark_at(current, definitions$landmark[i], point)
    }
    if (settled) break
  }
  places
}

landmarks_at <- function(specimen, names) {
  specimen$landmarks[match(names, rownames(specimen$landmarks)), , drop = FALSE]
}

#' The place of one definition with the point of the mesh, or why there is none
#' @noRd
located_place <- function(specimen, definition, given, inputs, pairs, curvature, settings) {
  start <- landmarks_at(list(landmarks = given), definition$landmark)[1, ]
  if (anyNA(start) || anyNA(inputs)) {
    return(list(state = "missing", reason = "a landmark is missing"))
  }
  # The place of a definition near a landmark
  find <- switch(definition$kind, cap = , cup = place_of_summit, profile = place_of_profile,
                 turn = place_of_turn, end = place_of_end, crossing = place_of_crossing)
  place <- tryCatch(
    find(specimen, definition, start, pairs, curvature, settings),
    crestline_error = function(e) {
      if (inherits(e, "crestline_wrong_mesh")) rlang::cnd_signal(e)
      list(reason = sub("\n.*", "", conditionMessage(e)))
    }
  )
  if (!is.null(place$reason)) {
    return(list(state = "none", reason = place$reason,
                point = surface_points(specimen$mesh, matrix(start, 1))))
  }
  place$state <- "found"
  place$point <- surface_points(specimen$mesh, matrix(place$at, 1))
  place
}

#' @return Data frame as `refinement` of [refine_landmarks()], without `moved`.
#' @noRd
refinement_table <- function(specimen, definitions, places) {
  state <- vapply(places, `[[`, "", "state")
  found <- state == "found"
  given <- landmarks_at(specimen, definitions$landmark)
  points <- surface_points(specimen$mesh,
                           given[0, , drop = FALSE])[rep(NA_integer_, nrow(definitions)), ]
  for (i in which(found)) points[i, ] <- places[[i]]$point
  text <- vapply(places, function(x) if (is.null(x$reason)) NA_character_ else x$reason, "")
  value <- vapply(places, function(x) if (is.null(x$value)) NA_real_ else as.numeric(x$value), 0)
  colnames(given) <- paste0("given_", c("x", "y", "z"))
  distance <- row_lengths(as.matrix(points[c("x", "y", "z")]) - given)
  data.frame(landmark = definitions$landmark, kind = definitions$kind, state = state,
             distance = distance, value = value,
             moved = FALSE, given, points, reason = text, row.names = NULL)
}

#' The landmarks of refine_landmarks() as they were given and as they are defined
#'
#' @return The scene of [draw_surface()], invisibly.
#' @noRd
draw_refinement <- function(specimen, view, labels, main, ..., engine = "picture") {
  check_flags(labels)
  main <- check_text(main, "main", null = TRUE)
  table <- specimen$refinement
  if (is.null(table)) {
    crestline_abort("the landmarks of `specimen` were not refined.",
                    "Give a specimen of refine_landmarks().", stage = "picture",
                    id = specimen$id)
  }
  engine <- check_engine(engine)
  if (engine == "picture") {
    old <- graphics::par(mar = c(0.5, 0.5, 2, 0.5))
    on.exit(graphics::par(old))
  }
  view <- posed_view(view, specimen$landmarks)
  scene <- draw_surface(specimen$mesh, "#E3CDB8", view, engine, ...)
  table <- table[table$state == "found", ]
  given <- as.matrix(table[paste0("given_", c("x", "y", "z"))])
  place <- as.matrix(table[c("x", "y", "z")])
  for (i in seq_len(nrow(table))) {
    scene <- draw_lines(in_layer(scene, "ways"), rbind(given[i, ], place[i, ]), "#C04000",
                        width = 2)
  }
  scene <- draw_points(in_layer(scene, "given"), given, "black", halo = "white",
                       name = paste(table$landmark, "as given"))
  scene <- draw_points(in_layer(scene, "defined"), place, "#FF7A00", halo = "white",
                       labels = if (labels) table$landmark,
                       name = paste(table$landmark, "as defined"))
  draw_title(scene, if (is.null(main)) specimen$id else main)
  shown(scene)
}

# The page on which a scheme is built: the object that turns, the forms, the lists; and what answers
# them. Its server and its scene are those of a review.

build_page <- function(title, defaults) {
  tags <- shiny::tags
  button <- function(id, label, title) shiny::actionButton(id, label, title = title)
  form <- function(heading, ...) tags$fieldset(tags$legend(heading), ...)
  shiny::fillPage(
    title = title,
    tags$head(shiny::includeCSS(review_file("review.css")),
              shiny::includeCSS(build_file("build.css")),
              tags$meta(name = "viewport", content = "width=device-width, initial-scale=1")),
    tags$div(
      id = "review", class = "build",
      tags$div(id = "view", rgl::rglwidgetOutput("face", width = "100%", height = "100%")),
      tags$div(
        id = "side", tags$h2(title), shiny::uiOutput("said"),
        landmark_form(form, button), curve_form(form, button, defaults),
        patch_form(form, button), scheme_form(form, button, defaults),
        shiny::uiOutput("list"),
        tags$p(class = "help", "Click on the surface: a landmark.",
               "Click on balls, one after another: the ends of the next curve.",
               "Drag a ball: it moves, and its curves with it.",
               "Drag the surface: turn; near the edge of the picture: roll.",
               "Wheel: nearer or farther. Right button and drag: shift.")
      )
    ),
    shiny::includeScript(review_file("review.js")), shiny::includeScript(review_file("ended.js")),
    shiny::includeScript(build_file("build.js"))
  )
}

build_file <- function(name) system.file("builder", name, package = "crestline", mustWork = TRUE)

#' A labelled field of a form
#' @noRd
field <- function(id, label, value, type = "text", ..., class = "") {
  shiny::tags$label(class = paste("field", class), label,
                    shiny::tags$input(id = id, type = type, value = value,
                                      class = "form-control", ...))
}

choice <- function(id, label, choices) {
  shiny::tags$label(class = "field", label,
                    shiny::selectInput(id, NULL, choices, selectize = FALSE, width = "100%"))
}

landmark_form <- function(form, button) {
  form("Landmarks", field("mark", "Name", "L1"),
       choice("snap", "Snap to", c("surface", "ridge", "valley", "cap", "cup")),
       button("rename", "Rename", "The chosen landmark gets this name"),
       button("remove_mark", "Remove", "The chosen landmark is removed"),
       button("suggest", "Suggest", "Show, or hide, the places that curvature suggests"))
}

curve_form <- function(form, button, defaults) {
  form("Curve", shiny::uiOutput("chain"), field("curve_name", "Name", ""),
       choice("kind", "Kind", c("ridge", "valley", "plane")),
       choice("path", "Path", c("plane", "crest")),
       field("radius", "Radius", signif(defaults$radius, 3), "number", min = 0, step = "any"),
       field("width", "Width", signif(1.5 * defaults$radius, 3), "number", min = 0, step = "any"),
       field("points", "Points", defaults$points, "number", min = 2, step = 1),
       shiny::tags$label(class = "field check",
                         shiny::checkboxInput("closed", "Closed", FALSE, width = "auto")),
       button("join", "Join", "A curve through the chosen landmarks, or the named one again"),
       button("clear", "Clear", "Choose anew"),
       button("remove_curve", "Remove", "The named curve is removed"))
}

patch_form <- function(form, button) {
  form("Patch", field("patch_name", "Name", ""),
       choice("curve_a", "From curve", character()), choice("curve_b", "To curve", character()),
       field("rows", "Rows", 5, "number", min = 2, step = 1),
       button("bound", "Bound", "The surface between the two curves"),
       button("remove_patch", "Remove", "The named patch is removed"))
}

scheme_form <- function(form, button, defaults) {
  form("Scheme", field("folder", "Folder", defaults$dir, class = "wide"),
       button("pairs", "Pairs", "Propose left-right pairs by the mirror image of the landmarks"),
       button("save", "Save", "Write the folder that read_scheme() takes"),
       button("undo", "Undo", "Take the last step back"),
       button("cancel", "Cancel", "End without any change"),
       button("done", "Done", "End with the scheme as it is"))
}

#' The functions of [scene_server()] for this page
#' @noRd
build_answers <- function(shown, view) {
  list(items = build_items, show = show_build, answer = answer_build, result = build_result,
       sent = build_sent, balls = build_balls,
       surface = function(state) list(key = "", shown = shown, view = view))
}

#' What the call on R's side gets: the specimen and the scheme as they are
#' @noRd
build_result <- function(state) {
  scheme <- as_value(build_scheme_of(state, pairs = TRUE))
  if (failed(scheme)) scheme <- build_scheme_of(state)
  list(specimen = state$specimen, scheme = scheme)
}

#' Everything that is drawn on the surface, by name: that of a review, suggestions and patches
#' @noRd
build_items <- function(state, faint = "#8A8F96", width = 1.5) {
  names <- build_names(state)
  shown <- list(specimen = state$specimen, fitting = state$fitting, pen = character(),
                about = data.frame(landmark = names), least = 0, selected = state$selected,
                state = stats::setNames(ifelse(names %in% state$chain, "found", "given"), names))
  suggested <- lapply(seq_len(NROW(state$suggested)), function(i) {
    row <- state$suggested[i, ]
    list(landmark = row$landmark, at = unlist(unclass(row)[c("x", "y", "z")]), colour = faint,
         size = 1.2)
  })
  names(suggested) <- paste("suggestion", state$suggested$landmark, recycle0 = TRUE)
  patches <- lapply(state$surface, function(patch) {
    # Column after column, each turned back: one line through all points
    at <- patch$points
    columns <- split(seq_len(nrow(at)), (seq_len(nrow(at)) - 1) %/% patch$rows)
    there <- unlist(lapply(seq_along(columns), function(i) {
      if (i %% 2) columns[[i]] else rev(columns[[i]])
    }))
    list(path = at[there[!is.na(at[there, 1])], , drop = FALSE], colour = faint, width = width)
  })
  patches <- Filter(function(item) nrow(item$path) > 1, patches)
  names(patches) <- paste("patch", names(patches), recycle0 = TRUE)
  c(review_items(shown), suggested, patches)
}

#' The balls that can be dragged, of which a click chooses
#' @noRd
build_balls <- function(state, frame) {
  lapply(build_names(state), function(name) {
    place <- found_landmark(state$specimen, name)
    c(drag_ball(name, unlist(place[c("x", "y", "z")]), place$face, state$specimen$mesh, frame),
      chooses = TRUE)
  })
}

#' What the page's script is told: what the forms offer
#' @noRd
build_sent <- function(state) {
  names <- build_names(state)
  row <- state$curves[match(c(state$curve, "")[1], state$curves$curve), ]
  shown <- if (NROW(row) && !is.na(row$curve)) {
    list(curve_name = row$curve, kind = row$kind, path = c(row$path, "plane")[1],
         radius = row$radius, width = row$width, points = row$n)
  }
  list(count = length(names), mark = free_name(names, "L"), curves = as.list(state$curves$curve),
       curve = shown)
}

#' What each input does
#'
#' @param step,frame,progress As in [answer_steps()].
#' @noRd
answer_build <- function(input, step, frame, progress) {
  try <- function(change) step(function(state) try_build(state, change))
  on <- function(id, change) shiny::observeEvent(input[[id]], try(change))
  shiny::observeEvent(input$ready, step(identity))
  on("select", function(state) pick_mark(state, input$select))
  on("ray", function(state) {
    click_build(state, scene_ray(input$ray, frame()), input$mark, input$snap)
  })
  on("drop", function(state) {
    ray <- scene_ray(input$drop$ray, frame())
    point <- mesh_on_ray(state$specimen$mesh, ray[1, ], ray[2, ])
    if (is.null(point)) with_said(state, "There is no surface: it stays where it was.") else
      place_mark(state, input$drop$name, point, input$snap)
  })
  on("rename", function(state) rename_mark(state, state$selected, input$mark))
  on("remove_mark", function(state) remove_mark(state, state$selected))
  on("suggest", suggest_marks)
  on("join", function(state) join_curve(state, form_row(input)))
  on("clear", function(state) with_said(utils::modifyList(state, list(chain = character())), ""))
  on("curve", function(state) {
    state$curve <- input$curve
    with_said(state, curve_words(state, input$curve))
  })
  on("remove_curve", function(state) remove_curve(state, input$curve_name))
  on("bound", function(state) {
    bound_patch(state, input$patch_name, input$curve_a, input$curve_b, form_number(input$rows))
  })
  on("remove_patch", function(state) remove_patch(state, input$patch_name))
  on("pairs", propose_pairs)
  on("save", function(state) save_build(state, input$folder))
  on("undo", undo_build)
}

#' The number that a field holds; NA where it holds none
#' @noRd
form_number <- function(x) suppressWarnings(as.numeric(c(x, NA)[1]))

form_row <- function(input) {
  list(curve = c(input$curve_name, "")[1], kind = input$kind, path = input$path,
       closed = isTRUE(input$closed), radius = form_number(input$radius),
       width = form_number(input$width), n = form_number(input$points))
}

#' What a click does: it chooses the landmark whose ball it meets, takes the suggestion that it
#' meets, else puts a new landmark on the surface
#' @noRd
click_build <- function(state, ray, name, snap) {
  suggested <- as.data.frame(state$suggested)
  grey <- as.matrix(suggested[c("x", "y", "z")[seq_len(3 * (NROW(suggested) > 0))]])
  rownames(grey) <- paste("suggestion", seq_len(nrow(grey)), recycle0 = TRUE)
  marks <- if (nrow(grey)) rbind(state$specimen$landmarks, grey) else state$specimen$landmarks
  scene <- list(specimen = list(mesh = state$specimen$mesh, landmarks = marks),
                selected = character())
  aim <- aimed_at(scene, ray[1, ], ray[2, ], formals(landmark_items)$size *
                  mesh_diagonal(state$specimen$mesh) / 400)
  if (isTRUE(aim$landmark %in% build_names(state))) return(pick_mark(state, aim$landmark))
  if (is.null(aim$landmark) && is.null(aim$point)) return(state)
  if (!is.null(aim$landmark)) {
    aim$point <- as.list(suggested[match(aim$landmark, rownames(grey)), mesh_columns])
    aim$point <- as.data.frame(aim$point)
    snap <- "surface"
  }
  if (name %in% build_names(state)) name <- free_name(build_names(state), "L")
  place_mark(state, name, aim$point, snap)
}

#' What the page shows beside the object
#' @noRd
show_build <- function(output, review) {
  tags <- shiny::tags
  output$said <- shiny::renderUI({
    state <- review()
    tags$p(id = "told", state$said)
  })
  output$chain <- shiny::renderUI({
    chain <- review()$chain
    tags$p(id = "chosen_marks", if (length(chain)) paste(chain, collapse = " \u2013 ") else
      "Click on two landmarks or more.")
  })
  output$list <- shiny::renderUI(build_list(review()))
}

#' The lists: landmarks, curves, patches and pairs
#' @noRd
build_list <- function(state) {
  tags <- shiny::tags
  row <- function(kind, name, words, colour, chosen, doubt = FALSE) {
    given <- stats::setNames(list(name), paste0("data-", kind))
    do.call(tags$button, c(given, list(
      type = "button", class = paste("row", kind, if (chosen) "chosen", if (doubt) "doubtful"),
      tags$span(class = "dot", style = paste0("background:", colour)), tags$b(name),
      tags$span(class = "long", title = words, words)
    )))
  }
  marks <- lapply(build_names(state), function(name) {
    row("landmark", name, shorten(curves_on(state$curves, name)), "#202020",
        identical(name, state$selected))
  })
  curves <- lapply(seq_len(NROW(state$curves)), function(i) {
    name <- state$curves$curve[i]
    words <- sub("^[^:]*: ", "", curve_words(state, name))
    doubt <- isFALSE(state$fitting$fits[[name]]$determined)
    row("curve", name, words, kind_colours[[state$curves$kind[i]]],
        identical(name, state$curve), doubt)
  })
  patches <- lapply(names(state$surface), function(name) {
    patch <- state$surface[[name]]
    words <- sprintf("patch of %d points%s", nrow(patch$points),
                     if (is.na(patch$reason)) "" else paste0("; ", patch$reason))
    row("patch", name, words, "#8A8F96", FALSE, !is.na(patch$reason))
  })
  pairs <- lapply(seq_len(NROW(state$pairs)), function(i) {
    tags$div(class = "row pair", tags$b(state$pairs$left[i]), "\u2013",
             tags$b(state$pairs$right[i]))
  })
  tags$div(id = "landmarks", marks, curves, patches, pairs)
}

# The page of a review: the face that turns, the list of landmarks, the buttons; and what answers
# them.

review_page <- function(title) {
  button <- function(id, label, title) shiny::actionButton(id, label, title = title)
  shiny::fillPage(
    title = title, shiny::tags$head(shiny::includeCSS(review_file("review.css"))),
    rgl::registerSceneChange(),
    shiny::tags$div(
      id = "review", shiny::tags$div(id = "view",
                                     rgl::rglwidgetOutput("face", width = "100%", height = "100%")),
      shiny::tags$div(
        id = "side", shiny::tags$h2(title), shiny::uiOutput("chosen"),
        shiny::tags$div(
          id = "buttons",
          button("keep", "It is right",
                 "The chosen landmark stays where it is and counts as placed"),
          button("absent", "Not on this scan", "The chosen landmark is missing on this scan"),
          button("undo", "Undo", "Take the last step back"),
          button("cancel", "Cancel", "End without any change"),
          button("done", "Done", "End with the landmarks as they are")
        ),
        shiny::uiOutput("list"),
        shiny::tags$p(class = "help",
                      "Click on the surface: the chosen landmark goes there.",
                      "Click on another's ball: that one is chosen.",
                      "Drag: turn. Wheel: nearer or farther. Right button and drag: shift.")
      )
    ),
    shiny::includeScript(review_file("review.js"))
  )
}

review_file <- function(name) system.file("review", name, package = "crestline", mustWork = TRUE)

#' What answers the page
#'
#' @param begin As of [begin_review()].
#' @param shown As of [shown_surface()].
#' @param view As in [draw_surface()].
#' @param finish Function of the specimen, called once, at the end.
#' @return Server function for shiny.
#' @noRd
review_server <- function(begin, shown, view, finish = shiny::stopApp) {
  page <- list(
    items = review_items,
    show = function(output, review) {
      output$chosen <- shiny::renderUI(chosen_html(review()))
      output$list <- shiny::renderUI(list_html(review()))
    },
    answer = answer_steps, result = function(review) review$specimen
  )
  scene_server(begin, shown, view, page, finish)
}

#' A server with one loop: every input makes the next state of what is edited, and what is drawn of
#' it changes
#'
#' @param begin The first state.
#' @param page List of functions: `items` of a state (as [review_items()]); `show` of the outputs
#'   and the reactive state; `answer` as [answer_steps()]; `result` of the last state; `sent` of a
#'   state (what the page's script is told after a step, a list; NULL: nothing).
#' @param shown,view,finish As in [review_server()].
#' @noRd
scene_server <- function(begin, shown, view, page, finish) {
  function(input, output, session) {
    review <- shiny::reactiveVal(begin)
    scene <- open_scene(shown, view)
    drawn <- list()
    step <- function(change) {
      review(change(review()))
      change <- redraw(scene, drawn, page$items(review()))
      drawn <<- change$drawn
      session$sendCustomMessage("sceneChange", rgl::sceneChange(
        "face", delete = change$delete, add = change$add
      ))
      if (!is.null(page$sent)) session$sendCustomMessage("state", page$sent(review(), shown$frame))
    }
    output$face <- rgl::renderRglwidget({
      rgl::set3d(scene$device)
      rgl::rglwidget()
    })
    page$show(output, review)
    page$answer(input, step, shown$frame, fitting_progress(session))
    answer_end(input, session, function() page$result(shiny::isolate(review())),
               page$result(begin), finish)
    session$onSessionEnded(function() rgl::close3d(scene$device))
  }
}

#' What each input does to the review
#'
#' @param step Function of a function of the review that gives the next one.
#' @param frame As of [scene_frame()].
#' @noRd
answer_steps <- function(input, step, frame, progress) {
  # The scene is in the browser: now landmarks and curves can be sent to it.
  shiny::observeEvent(input$ready, step(function(now) {
    if (!is.null(now$fitting)) {
      now$fitting <- refit_curves(now$fitting, now$specimen, progress = progress)
    }
    now
  }))
  shiny::observeEvent(input$select, step(function(now) select_landmark(now, input$select)))
  shiny::observeEvent(input$ray, step(function(now) {
    # What a click does: it chooses the landmark whose ball it meets, else places the chosen one
    ends <- from_scene(
      rbind(as.numeric(unlist(input$ray$from)), as.numeric(unlist(input$ray$towards))), frame
    )
    # Radius of the ball of a landmark, in the unit of the mesh
    aim <- aimed_at(now, ends[1, ], ends[2, ], formals(landmark_items)$size *
                    mesh_diagonal(now$specimen$mesh) / 400)
    if (!is.null(aim$landmark)) return(select_landmark(now, aim$landmark))
    if (is.null(aim$point)) now else place_selected(now, aim$point, progress)
  }))
  shiny::observeEvent(input$keep, step(function(now) keep_selected(now, progress)))
  shiny::observeEvent(input$absent, step(function(now) place_selected(now, NULL, progress)))
  shiny::observeEvent(input$undo, step(undo_review))
}

#' The ways a review ends; only the first counts
#' @noRd
answer_end <- function(input, session, current, before, finish) {
  ended <- FALSE
  end <- function(specimen) {
    if (!ended) finish(specimen)
    ended <<- TRUE
  }
  shiny::observeEvent(input$done, end(current()))
  shiny::observeEvent(input$cancel, end(before))
  session$onSessionEnded(function() end(current()))
}

#' A bar that moves with every curve that is fitted
#' @noRd
fitting_progress <- function(session) {
  function(n) {
    if (n == 0) return(function() NULL)
    bar <- shiny::Progress$new(session)
    bar$set(0, sprintf("Fitting %s", amount(n, "curve")))
    done <- 0
    function() {
      done <<- done + 1
      bar$set(done / n)
      if (done == n) bar$close()
    }
  }
}

#' The chosen landmark: its name, where it belongs, its curves
#' @noRd
chosen_html <- function(review) {
  tags <- shiny::tags
  name <- review$selected
  waiting <- sum(is_open(review))
  left <- if (waiting) sprintf("%s to look at", amount(waiting, "landmark")) else
    "No landmark is missing or doubtful"
  mirrored <- if (specimen_slips(review$specimen)$mirrored) {
    tags$p(class = "warning",
           "Left and right look mirrored: names that end in L belong to the subject's own left.")
  }
  if (!length(name)) {
    return(tags$div(tags$p(class = "where", "Choose a landmark: in the list, or its ball."),
                    tags$p(left), mirrored))
  }
  row <- match(name, review$about$landmark)
  # The curves that a landmark is an end of: kind, length, what there is to say
  curves <- review$fitting$scheme$curves
  own <- which(curves$from == name | curves$to == name)
  fits <- review$fitting$fits[own]
  value <- function(field, none) {
    vapply(fits, function(fit) if (is.null(fit[[field]])) none else fit[[field]], none)
  }
  curves <- data.frame(curve = curves$curve[own], kind = curves$kind[own],
                       length = value("length", NA_real_), reason = value("reason", NA_character_),
                       row.names = NULL)
  said <- paste0(curves$curve, ": ", curves$kind,
                 ifelse(is.na(curves$length), "", sprintf(", %.4g long", curves$length)),
                 ifelse(is.na(curves$reason), "", paste0("; ", curves$reason)))
  tags$div(tags$p(class = "name", tags$b(name), review$about$name[row]),
           tags$p(class = "where", review$about$where[row]), tags$p(left), mirrored,
           if (nrow(curves)) {
             tags$details(tags$summary(amount(nrow(curves), "curve")),
                          tags$ul(lapply(said, tags$li)))
           })
}

#' What looks exchanged among the landmarks of a specimen as they are now
#' @noRd
specimen_slips <- function(specimen) {
  known <- specimen$geometry
  slips_by_name(known$landmarks, known$located, specimen$mesh,
                eval(formals(crestline::specimen)$midline))
}

#' The list of landmarks: a row a landmark, with its state
#' @noRd
list_html <- function(review) {
  tags <- shiny::tags
  colours <- review_colours()$state
  confidence <- review$specimen$placing$confidence[match(
    review$about$landmark, review$specimen$placing$landmark
  )]
  state <- ifelse(is_doubtful(review), "doubtful", review$state)
  told <- if (is.null(confidence)) state else
    ifelse(is.na(confidence), state, sprintf("%s %.2f", state, confidence))
  rows <- lapply(seq_along(state), function(i) {
    name <- review$about$landmark[i]
    colour <- if (state[i] %in% names(colours)) colours[[state[i]]] else "transparent"
    chosen <- if (identical(name, review$selected)) "chosen"
    tags$button(type = "button", class = paste("row", state[i], chosen), `data-landmark` = name,
                tags$span(class = "dot", style = paste0("background:", colour)), tags$b(name),
                tags$span(class = "long", review$about$name[i]),
                tags$span(class = "state", told[i]))
  })
  tags$div(id = "landmarks", rows)
}

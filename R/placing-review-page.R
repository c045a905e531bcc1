# The page of a review: the face that turns, the list of landmarks, the buttons; and what answers
# them.

#' @param several Whether there is a next specimen.
#' @param cancel Whether the page can end without any change.
#' @param kept Where the work is, as the page says at its end.
#' @noRd
review_page <- function(title, several = FALSE, cancel = TRUE,
                        kept = "The landmarks and curves are the value of the call in R.") {
  tags <- shiny::tags
  button <- function(id, label, title) shiny::actionButton(id, label, title = title)
  shiny::fillPage(
    title = title,
    tags$head(shiny::includeCSS(review_file("review.css")),
              tags$meta(name = "viewport", content = "width=device-width, initial-scale=1")),
    tags$div(
      id = "review", `data-kept` = kept,
      tags$div(id = "view", rgl::rglwidgetOutput("face", width = "100%", height = "100%")),
      view_buttons(),
      tags$div(
        id = "side", tags$h2(title), shiny::uiOutput("desk"),
        if (several) tags$div(id = "turn",
                              button("previous", "Previous", "The specimen before (P)"),
                              button("following", "Next", "The next specimen (N)")),
        shiny::uiOutput("chosen"), review_buttons(button, cancel), shiny::uiOutput("list"),
        line_colours(),
        tags$p(class = "help", "Click on the surface: the chosen landmark goes there, or the",
               "chosen curve gets a point. Click on a ball: that one is chosen; then drag it to",
               "move it. Drag the surface: turn; near the edge of the picture: roll.",
               "Wheel: nearer or farther. Right button and drag: shift."),
        tags$p(class = "help", "Keys: up, down: the list. Enter: right. Delete: not there, or",
               "erase. S: snap. U, R: undo, redo. 1, 2, 3: its right side, front, its left side.",
               if (several) "P, N: previous, next specimen.")
      )
    ),
    shiny::includeScript(review_file("review.js")), shiny::includeScript(review_file("ended.js"))
  )
}

#' Straight views: from the front, and from both sides of the subject
#' @noRd
view_buttons <- function() {
  one <- function(label, degrees, title) {
    shiny::tags$button(type = "button", class = "btn btn-default", `data-turn` = degrees,
                       title = title, label)
  }
  shiny::tags$div(id = "views",
                  one("Right side", 90, "The subject's own right side (1)"),
                  one("Front", 0, "From the front, the whole of it (2)"),
                  one("Left side", -90, "The subject's own left side (3)"))
}

#' What the colours of lines mean
#' @noRd
line_colours <- function() {
  one <- function(colour, ...) {
    list(shiny::tags$span(class = "dot", style = paste0("background:", colour)), ...)
  }
  shiny::tags$p(id = "lines", class = "help", one(kind_colours[["ridge"]], "ridge"),
                one(kind_colours[["valley"]], "valley"), one(kind_colours[["plane"]], "plane"),
                one(review_colours()$selected, "chosen; thick: drawn"))
}

review_buttons <- function(button, cancel) {
  shiny::tags$div(
    id = "buttons",
    button("keep", "It is right", "The chosen landmark stays where it is and counts as placed"),
    button("absent", "Not on this scan", "The chosen landmark is missing on this scan"),
    button("snap", "Snap", "Lay the chosen curve onto the ridge or valley beside it"),
    button("erase", "Erase", "What was drawn of the chosen curve goes away"),
    button("undo", "Undo", "Take the last step back"),
    button("redo", "Redo", "Make the step again that was taken back"),
    if (cancel) button("cancel", "Cancel", "End without any change"),
    button("done", "Done", "End with the landmarks and curves as they are")
  )
}

review_file <- function(name) system.file("review", name, package = "crestline", mustWork = TRUE)

#' What answers the page
#'
#' @param desk As of [begin_desk()].
#' @param surface As of [desk_surfaces()].
#' @param finish Function of the result, called once, at the end.
#' @param result Function of the last desk.
#' @return Server function for shiny.
#' @noRd
desk_server <- function(desk, surface, finish = shiny::stopApp,
                        result = function(desk) reviewed_specimen(current_review(desk))) {
  page <- list(
    items = function(desk) c(review_items(current_review(desk)), knot_items(current_review(desk))),
    show = function(output, desk) {
      output$desk <- shiny::renderUI(shiny::tags$p(id = "where", desk_words(desk())))
      output$chosen <- shiny::renderUI(chosen_html(current_review(desk())))
      output$list <- shiny::renderUI(list_html(current_review(desk())))
    },
    answer = answer_steps, result = result, surface = surface,
    balls = function(desk, frame) review_balls(current_review(desk), frame)
  )
  scene_server(desk, page, finish)
}

#' The surface of the specimen that a desk shows
#'
#' @param surface,view As in [review_landmarks()].
#' @param page [review_settings()].
#' @return Function of a desk: list of `key`, `shown` (as of [shown_surface()]), `view`.
#' @noRd
desk_surfaces <- function(surface, page, view = NULL) {
  known <- list()
  function(desk) {
    specimen <- current_review(desk)$specimen
    if (is.null(known[[desk$at]])) {
      radius <- if (is.null(page$radius)) mesh_diagonal(specimen$mesh) / 25 else page$radius
      own <- if (!is.null(view)) view else
        if (is.null(specimen$match)) "front" else t(specimen$match$rotation)
      known[[desk$at]] <<- list(key = desk$at, view = own,
                                shown = shown_surface(specimen, surface, radius, page$faces))
    }
    known[[desk$at]]
  }
}

#' A server with one loop: every input makes the next state of what is edited, and what is drawn of
#' it changes
#'
#' @param begin The first state.
#' @param page List of functions: `surface` of a state (as of [desk_surfaces()]); `items` of a state
#'   (as [review_items()]); `show` of the outputs and the reactive state; `answer` as
#'   [answer_steps()]; `result` of the last state; `balls` of a state and a frame (as
#'   [review_balls()]); `sent` of a state (what the page's script is told after a step, a list;
#'   NULL: nothing).
#' @param finish As in [desk_server()].
#' @noRd
scene_server <- function(begin, page, finish) {
  function(input, output, session) {
    review <- shiny::reactiveVal(begin)
    seen <- page$surface(begin)
    scene <- open_scene(seen$shown, seen$view)
    opened <- shiny::reactiveVal(1)
    drawn <- list()
    send <- function() {
      changed <- redraw(scene, drawn, page$items(review()))
      drawn <<- changed$drawn
      session$sendCustomMessage("change", rgl::sceneChange(
        "face", delete = changed$delete, add = changed$add
      ))
      session$sendCustomMessage("balls", page$balls(review(), scene$frame))
      if (!is.null(page$sent)) session$sendCustomMessage("state", page$sent(review()))
    }
    step <- function(change) {
      review(change(review()))
      now <- page$surface(review())
      if (identical(now$key, seen$key)) return(send())
      # Another surface: what is drawn on it follows when the browser has it
      rgl::close3d(scene$device)
      seen <<- now
      scene <<- open_scene(now$shown, now$view)
      drawn <<- list()
      opened(opened() + 1)
    }
    output$face <- rgl::renderRglwidget({
      opened()
      rgl::set3d(scene$device)
      rgl::rglwidget()
    })
    page$show(output, review)
    page$answer(input, step, function() scene$frame, fitting_progress(session))
    answer_end(input, session, function() page$result(shiny::isolate(review())),
               page$result(begin), finish)
    session$onSessionEnded(function() rgl::close3d(scene$device))
  }
}

#' What each input does to the desk
#'
#' @param step Function of a function of the desk that gives the next one.
#' @param frame Function that gives the [scene_frame()] of what is shown.
#' @noRd
answer_steps <- function(input, step, frame, progress) {
  on <- function(id, change, of = on_current) {
    shiny::observeEvent(input[[id]], step(function(desk) of(desk, change)))
  }
  # The scene is in the browser: now landmarks and curves can be sent to it.
  shiny::observeEvent(input$ready, step(identity))
  on("ready", function(now) {
    if (!is.null(now$fitting) && is.null(now$fitting$refitted)) {
      now$fitting <- refit_curves(now$fitting, now$specimen, progress = progress)
    }
    now
  })
  on("select", function(now) select_landmark(now, input$select))
  on("curve", function(now) choose_curve(now, input$curve))
  on("ray", function(now) click_review(now, scene_ray(input$ray, frame()), progress))
  on("drop", function(now) {
    drop_ball(now, input$drop$name, scene_ray(input$drop$ray, frame()), progress)
  })
  on("keep", function(now) keep_selected(now, progress))
  on("absent", function(now) place_selected(now, NULL, progress))
  on("snap", snap_line)
  on("erase", erase_curve)
  on("undo", undo_review)
  on("redo", redo_review)
  on("choose", function(now) choose_next(now, input$choose))
  shiny::observeEvent(input$following, step(function(desk) turn_to(desk, 1)))
  shiny::observeEvent(input$previous, step(function(desk) turn_to(desk, -1)))
}

#' What a click does: on a knot of the chosen curve it takes it away, on another landmark's ball it
#' chooses it, on the surface it places what is chosen
#'
#' @param ray Its ends, 2 x 3, in the unit of the mesh.
#' @noRd
click_review <- function(review, ray, progress) {
  # Radius of the ball of a landmark, in the unit of the mesh
  reach <- formals(landmark_items)$size * mesh_diagonal(review$specimen$mesh) / 400
  if (length(review$pen)) {
    knots <- review$drawn[[review$pen]]$knots
    scene <- list(specimen = list(mesh = review$specimen$mesh, landmarks = named_knots(knots)),
                  selected = character())
    aim <- aimed_at(scene, ray[1, ], ray[2, ], reach)
    if (!is.null(aim$landmark)) return(move_knot(review, as.integer(aim$landmark), NULL))
    return(if (is.null(aim$point)) review else add_knot(review, aim$point))
  }
  aim <- aimed_at(review, ray[1, ], ray[2, ], reach)
  if (!is.null(aim$landmark)) return(select_landmark(review, aim$landmark))
  if (is.null(aim$point)) review else place_selected(review, aim$point, progress)
}

#' Knots as landmarks that are named by their numbers
#' @noRd
named_knots <- function(knots) {
  at <- if (is.null(knots)) matrix(0, 0, 3) else knots[, 1:3, drop = FALSE]
  dimnames(at) <- list(as.character(seq_len(nrow(at))), c("x", "y", "z"))
  at
}

#' A ball that was dragged: it goes where it was let go
#' @noRd
drop_ball <- function(review, name, ray, progress) {
  point <- mesh_on_ray(review$specimen$mesh, ray[1, ], ray[2, ])
  if (is.null(point)) return(with_said(review, "There is no surface: it stays where it was."))
  if (length(review$pen)) return(move_knot(review, match(name, seq_len(1e4)), point))
  place_selected(select_landmark(review, name), point, progress)
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

#' The chosen landmark or curve: its name, where it belongs, what there is to say of it
#' @noRd
chosen_html <- function(review) {
  tags <- shiny::tags
  waiting <- sum(is_open(review))
  unplaced <- sum(review$state == "missing")
  left <- if (unplaced) sprintf("%s to place", amount(unplaced, "landmark")) else
    if (waiting) sprintf("%s to look at", amount(waiting, "landmark")) else done_words(review)
  mirrored <- if (specimen_slips(review$specimen)$mirrored) {
    tags$p(class = "warning",
           "Left and right look mirrored: names that end in L belong to the subject's own left.")
  }
  line <- review$drawn[[c(review$pen, "")[1]]]
  known <- !is.null(line) && identical(review$said, line_words(review$pen, line))
  said <- tags$p(id = "told", if (!known) review$said)
  if (length(review$pen)) return(tags$div(chosen_curve(review), said))
  name <- review$selected
  if (!length(name)) {
    return(tags$div(tags$p(class = "where", "Choose a landmark or a curve in the list."),
                    tags$p(left), said, mirrored))
  }
  row <- match(name, review$about$landmark)
  tags$div(tags$p(class = "name", tags$b(name), review$about$name[row]),
           tags$p(class = "where", review$about$where[row]),
           side_line(review, name, "landmarks"), record_line(review, name, "landmarks"),
           tags$p(left), said, mirrored,
           curves_at(review, name))
}

#' What there is to say when no landmark waits; what absent ones cost, and the remedy
#' @noRd
done_words <- function(review) {
  absent <- names(which(review$state == "absent"))
  if (!length(absent)) {
    return("No landmark is missing or doubtful: look at the curves, draw them, or go on")
  }
  scheme <- review$fitting$scheme
  cut <- scheme$curves$curve[scheme$curves$from %in% absent | scheme$curves$to %in% absent]
  cut <- setdiff(cut, names(Filter(function(line) !is.null(line$path), review$drawn)))
  lost <- if (length(cut)) {
    sprintf(": %s and %d of %s cannot be measured. %s", amount(length(cut), "curve"),
            surface_without(scheme, cut, absent),
            amount(sum(scheme$points$level == "surface"), "surface point"),
            "Predict them in R: find_landmarks(specimen) keeps the others")
  }
  paste0(amount(length(absent), "landmark"), " not on this scan (", shorten(absent, 4), ")", lost)
}

side_line <- function(review, name, level) {
  words <- side_words(review, name, level)
  if (length(words)) shiny::tags$p(class = "side", words)
}

record_line <- function(review, name, level) {
  words <- record_words(review, name, level)
  if (length(words)) shiny::tags$p(class = "record", words)
}

#' The curve that is drawn now
#' @noRd
chosen_curve <- function(review) {
  tags <- shiny::tags
  row <- curve_row(review, review$pen)
  line <- review$drawn[[review$pen]]
  tags$div(
    tags$p(class = "name", tags$b(review$pen), row$kind),
    tags$p(class = "where", sprintf("from %s to %s", row$from, row$to)),
    side_line(review, review$pen, "curves"), record_line(review, review$pen, "curves"),
    tags$p(if (is.null(line)) "Click along it: the line follows the surface." else
      line_words(review$pen, line)),
    if (!is.na(doubt <- curve_doubt(review, review$pen))) {
      tags$p(class = "warning", paste0("Look at it: ", doubt, "."))
    }
  )
}

#' The curves that a landmark is an end of: kind, length, what there is to say
#' @noRd
curves_at <- function(review, name) {
  tags <- shiny::tags
  curves <- review$fitting$scheme$curves
  own <- which(curves$from == name | curves$to == name)
  if (!length(own)) return(NULL)
  fits <- review$fitting$fits[own]
  value <- function(field, none) {
    vapply(fits, function(fit) if (is.null(fit[[field]])) none else fit[[field]], none)
  }
  length <- value("length", NA_real_)
  reason <- value("reason", NA_character_)
  said <- paste0(curves$curve[own], ": ", curves$kind[own],
                 ifelse(is.na(length), "", sprintf(", %.4g long", length)),
                 ifelse(is.na(reason), "", paste0("; ", reason)))
  tags$details(tags$summary(paste(
    amount(length(own), "curve"), if (length(own) == 1) "ends here" else "end here"
  )), tags$ul(lapply(said, tags$li)))
}

#' What looks exchanged among the landmarks of a specimen as they are now
#' @noRd
specimen_slips <- function(specimen) {
  known <- specimen$geometry
  slips_by_name(known$landmarks, known$located, specimen$mesh,
                eval(formals(crestline::specimen)$midline))
}

#' The list: a row a landmark, with its state, and a row a curve
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
    list_row("landmark", name, review$about$name[i], told[i], colour, state[i],
             identical(name, review$selected), record_words(review, name, "landmarks"))
  })
  curves <- review$fitting$scheme$curves
  lines <- lapply(seq_len(NROW(curves)), function(i) {
    name <- curves$curve[i]
    line <- review$drawn[[name]]
    state <- if (is.null(line)) "" else if (line$snapped) "snapped" else "drawn"
    doubt <- curve_doubt(review, name)
    unseen <- is.null(line$path) && is.null(review$fitting$fits[[name]]$path)
    list_row("curve", name, curves$kind[i],
             if (is.na(doubt)) state else paste(c(state[nzchar(state)], "look"), collapse = ", "),
             kind_colours[[curves$kind[i]]],
             c(state, if (!is.na(doubt)) "doubtful", if (unseen) "unseen"),
             identical(name, review$pen),
             c(record_words(review, name, "curves"), if (!is.na(doubt)) doubt,
               if (unseen) unseen_words(review, name)))
  })
  tags$div(id = "landmarks", rows, lines)
}

#' Why a curve has no line
#' @noRd
unseen_words <- function(review, name) {
  reason <- c(review$fitting$fits[[name]]$reason, NA)[1]
  if (is.na(reason)) "there is no line yet" else paste("there is no line:", reason)
}

list_row <- function(kind, name, words, told, colour, state, chosen, record) {
  tags <- shiny::tags
  given <- stats::setNames(list(name), paste0("data-", kind))
  do.call(tags$button, c(given, list(
    type = "button", class = paste(c("row", kind, state, if (chosen) "chosen"), collapse = " "),
    title = if (length(record)) paste(record, collapse = "; "),
    tags$span(class = "dot", style = paste0("background:", colour)), tags$b(name),
    tags$span(class = "long", words), tags$span(class = "state", told)
  )))
}

#' Who did what to a landmark or curve last, and when
#' @noRd
record_words <- function(review, name, level) {
  own <- utils::tail(review$log[review$log$part == name & review$log$level == level, ], 1)
  if (!nrow(own)) return(NULL)
  paste0(own$action, if (nzchar(own$by)) paste(" by", own$by), ", ", own$time)
}

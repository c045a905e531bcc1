# The whole job on a page, without code.

#' The whole job on a page, without code
#'
#' Opens a page in the browser (package shiny) on which a folder of scans goes to a comparison of
#' groups: landmarks found, read or placed by hand, every scan measured, quality, homologous points,
#' groups from a table, tests, pictures and tables. The page shows the R code of every step. It is
#' the code that was run: the same code in a script gives the same numbers.
#'
#' * *Scans*: a folder with PLY, OBJ or STL files. Results go into its folder `output`.
#' * *Landmarks*: "Find" leaves them to [find_landmarks()]. "Beside" reads the landmark file beside
#'   each scan. "By hand" opens the page of [digitise()], with the found landmarks once the scans
#'   are measured. After "Done" there you are back here.
#' * *Measure*: [fit_shapes()], with a bar. Scans that fail are listed with the reason and the
#'   remedy. "Quality" is [quality()] and [quality_report()], "Homologise" [homologise()].
#' * *Compare*: a table with a column of names (those of the files, without extension) and one of
#'   groups; [compare_groups()] with a seed.
#' * *Out*: pictures and pages, tables, the code as `output/analysis.R`.
#'
#' @param dir Folder that the page proposes.
#' @param port Port of this computer, or NULL: a free one.
#' @param ... `launch.browser` and `quiet` of [shiny::runApp()], as in [review_landmarks()].
#' @details The page runs on this computer only (127.0.0.1). Its address has a random token. R
#'   answers only requests with this token, and none from pages of another site.
#' @return Invisibly a list: `code` (lines, the whole analysis) and `values` (list by name of what
#'   it made, such as `shapes`, `sample`, `compared`).
#' @section Errors: of class `crestline_error`: an argument is wrong, or a package is not installed.
#'   Errors appear on the page.
#' @template glossary
#' @seealso [digitise()], [fit_shapes()], [quality_report()], [homologise()], [compare_groups()];
#'   [run_command()] for a shell
#' @examplesIf interactive() && requireNamespace("shiny", quietly = TRUE)
#' done <- crestline_app("scans")
#' cat(done$code, sep = "\n")
#' @export
crestline_app <- function(dir = "", port = NULL, ...) {
  check_given()
  dir <- check_text(dir, "dir")
  if (!is.null(port)) port <- check_count(port, "port", upper = 65535)
  check_dots(..., known = c("launch.browser", "quiet"))
  rlang::check_installed(c("shiny", "future", "progressr"), "to run the app.")
  if (is.null(port)) port <- httpuv::randomPort()
  address <- list(token = random_token(), port = port, host = "127.0.0.1", ...)
  state <- begin_app()
  repeat {
    ended <- do.call(run_review, c(list(app_page(dir), app_server(state)), address))
    state <- ended$state
    if (!ended$desk) break
    # The page waits for the next one at its own address
    address$launch.browser <- function(url) NULL
    state <- app_by_hand(state, ended$form, address)
    dir <- ended$form$folder
  }
  invisible(list(code = state$code, values = as.list(state$values)))
}

#' The desk in between: its records become the landmarks
#' @noRd
app_by_hand <- function(state, form, address) {
  wanted <- app_desk(state)
  scheme <- state$values$scheme
  desk <- tryCatch({
    desk <- desk_from(desk_sources(wanted$sources), scheme,
                      file.path(state$values$dir, "desk"), form$observer, wanted$blank,
                      ridge_settings(error = FALSE), review_settings())
    page <- review_page("By hand", several = length(desk$ids) > 1, cancel = FALSE)
    do.call(run_review, c(list(page, desk_server(desk, desk_surfaces("natural", review_settings()),
                                                 result = identity)), address))
  }, crestline_error = identity)
  if (inherits(desk, "crestline_error")) {
    return(after_failure(state, paste(desk$problem, desk$remedy)))
  }
  # Of measured scans all are kept, untouched and unseen ones too
  for (id in if (wanted$blank) names(desk$reviews) else desk$ids) {
    review <- desk$reviews[[id]]
    if (is.null(review)) review <- as_value(desk$open(id))
    if (!failed(review)) keep_review(review, file.path(state$values$dir, "desk"))
  }
  do_step(state, "hand", form)
}

#' What answers the page
#' @noRd
app_server <- function(begin) {
  function(input, output, session) {
    state <- shiny::reactiveVal(begin)
    ended <- FALSE
    form <- function() {
      names <- c("folder", "scheme", "observer", "errors", "table", "id", "by", "level",
                 "permutations", "seed")
      shiny::isolate(stats::setNames(lapply(names, function(name) input[[name]]), names))
    }
    end <- function(desk) {
      if (!ended) shiny::stopApp(list(state = shiny::isolate(state()), desk = desk,
                                      form = form()))
      ended <<- TRUE
    }
    lapply(setdiff(names(app_needs()), "hand"), function(name) {
      shiny::observeEvent(input[[paste0("step_", name)]], {
        state(do_step(state(), name, form(), function(code) with_bar(code, session, name)))
      })
    })
    shiny::observeEvent(input$desk, {
      ready <- all(c("files", "scheme") %in% ls(state()$values))
      if (ready && nzchar(form()$observer)) end(TRUE) else
        state(after_failure(state(), "Look at a folder of scans first, and name the observer."))
    })
    shiny::observeEvent(input$save, state(save_code(state())))
    shiny::observeEvent(input$done, end(FALSE))
    output$told <- shiny::renderUI(told_html(state()))
    output$files <- shiny::renderUI(files_html(state()))
    output$code <- shiny::renderText(paste(state()$code, collapse = "\n"))
    session$onSessionEnded(function() end(FALSE))
  }
}

#' Code that runs under a bar on the page: it moves with every scan
#' @noRd
with_bar <- function(code, session, name) {
  bar <- shiny::Progress$new(session)
  on.exit(bar$close())
  bar$set(0, app_titles()[[name]])
  reporter <- list(update = function(config, state, progression, ...) {
    bar$set(state$step / max(config$max_steps, 1),
            detail = sprintf("%d of %d", state$step, config$max_steps))
  })
  handler <- progressr::make_progression_handler("crestline", reporter, intrusiveness = 0,
                                                 enable = TRUE)
  before <- options(progressr.enable = TRUE, progressr.handlers = handler)
  on.exit(options(before), add = TRUE)
  force(code)
}

save_code <- function(state) {
  output <- state$values$output
  if (is.null(output)) return(after_failure(state, "Look at a folder of scans first."))
  file <- file.path(output, "analysis.R")
  writeLines(state$code, file)
  state[c("shown", "told", "failed")] <- list(character(), paste("Saved in", file), FALSE)
  state
}

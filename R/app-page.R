# The page of the app: the steps with their fields, what the last one said, and the code.

app_page <- function(dir, columns = c("id", "group")) {
  tags <- shiny::tags
  shiny::fillPage(
    title = "crestline",
    tags$head(shiny::includeCSS(review_file("review.css")), shiny::includeCSS(app_file("app.css")),
              tags$meta(name = "viewport", content = "width=device-width, initial-scale=1")),
    tags$div(
      id = "app",
      tags$div(id = "steps", tags$h2("crestline"), app_forms(dir, columns)),
      tags$div(id = "results", shiny::uiOutput("told"), shiny::uiOutput("files"),
               tags$h2("Code"),
               tags$p(class = "help", "What was run. Run again, it gives the same numbers."),
               shiny::verbatimTextOutput("code"))
    ),
    shiny::includeScript(review_file("ended.js"))
  )
}

#' The steps of the app, one form each
#' @noRd
app_forms <- function(dir, columns) {
  tags <- shiny::tags
  button <- function(id, label, title) shiny::actionButton(id, label, title = title)
  form <- function(heading, ...) tags$fieldset(tags$legend(heading), ...)
  shiny::tagList(
    form("1 Scans", field("folder", "Folder", dir, class = "wide"),
         field("scheme", "Folder of a scheme; empty: the face's", "", class = "wide"),
         button("step_folder", "Look", "List the scans of the folder")),
    form("2 Landmarks", button("step_find", "Find", "Landmarks are found by machine"),
         button("step_beside", "Beside", "Landmarks are in files beside the scans"),
         field("observer", "Observer", "me"),
         button("desk", "By hand", "Place landmarks, or check those that were found")),
    form("3 Measure", shiny::checkboxInput("errors", "Standard errors", FALSE),
         button("step_measure", "Measure", "Measure every scan"),
         button("step_quality", "Quality", "Grade all parts, and write a page"),
         button("step_homologise", "Homologise", "Make the points homologous")),
    form("4 Compare", field("table", "Table of groups (.csv)", "", class = "wide"),
         field("id", "Column of names", columns[1]),
         field("by", "Column of groups", columns[2]),
         button("step_groups", "Groups", "Read the table"),
         choice("level", "Points", c("curves", "landmarks", "surface")),
         field("permutations", "Permutations", 1000, "number", min = 99, step = 1),
         field("seed", "Seed", 1, "number", min = 1, step = 1),
         button("step_compare", "Compare", "Test the groups by permutation")),
    form("5 Out", button("step_pictures", "Pictures", "Write pictures and pages"),
         button("step_exports", "Tables", "Write tables for other programs"),
         button("save", "Save code", "Write output/analysis.R"),
         button("done", "Done", "End; R gets the code and what it made"))
  )
}

app_file <- function(name) system.file("app", name, package = "crestline", mustWork = TRUE)

#' What the last step said, and what it printed
#' @noRd
told_html <- function(state) {
  tags <- shiny::tags
  last <- utils::tail(state$steps, 1)
  head <- if (state$failed) "This step was not done" else
    if (length(last)) paste0(app_titles()[[last]], ": done") else "Begin with a folder of scans"
  tags$div(id = "said", class = if (state$failed) "failed", tags$h2(head),
           lapply(state$told, tags$p), if (length(state$shown)) {
             tags$pre(paste(state$shown, collapse = "\n"))
           })
}

#' The files that were written
#' @noRd
files_html <- function(state) {
  output <- state$values$output
  files <- if (!is.null(output)) list.files(output, "[.](html|png|csv|rds|R)$")
  if (!length(files)) return(NULL)
  shiny::tags$p(class = "help", sprintf("In %s: %s", output, paste(files, collapse = ", ")))
}

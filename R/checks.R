# One small checker owns one kind of argument: it says what is wrong and what to do.

#' What can no longer be meant, or would fill the memory before the first result
#'
#' @return List: `count` (numbers of points, rounds, components), `permutations`, `threads`,
#'   `pixels` (of a picture with its samples, 8 bytes each in 5 planes: 8 GB), `vertices` (of a
#'   surface that is made), `bytes` (of a result that is held in memory at once).
#' @noRd
argument_limits <- function() {
  list(count = 1e6, permutations = 1e7, threads = 1024, pixels = 2e8, vertices = 5e7,
       bytes = 1.6e10)
}

refuse_argument <- function(name, x, remedy, said = describe_value(x)) {
  crestline_abort(sprintf("`%s` is %s.", name, said), remedy, stage = "arguments")
}

check_number <- function(x, name, lower = -Inf, upper = Inf, open = FALSE) {
  ok <- is.numeric(x) && length(x) == 1 && is.finite(x) &&
    (if (open) x > lower && x < upper else x >= lower && x <= upper)
  if (!ok) {
    refuse_argument(name, x,
                    sprintf("Give one finite number %s.", describe_range(lower, upper, open)))
  }
  as.numeric(x)
}

check_count <- function(x, name, lower = 1, upper = argument_limits()$count) {
  x <- check_number(x, name, lower = lower, upper = upper)
  if (x != round(x)) refuse_argument(name, x, "Give a whole number.")
  as.integer(x)
}

check_threads <- function(threads) {
  check_count(threads, "threads", upper = argument_limits()$threads)
}

#' A length as a share of another, above 0; Inf: without end
#' @noRd
check_reach <- function(reach, name = "reach") {
  if (identical(reach, Inf)) reach else
    check_number(reach, name, lower = 0, open = TRUE)
}

#' A vector of finite numbers, or of NA too
#' @param n How many; any number but 0 where NULL.
#' @noRd
check_numbers <- function(x, name, n = NULL, lower = -Inf, upper = Inf, missing = FALSE) {
  number <- is.numeric(x) || (missing && is.logical(x) && all(is.na(x)))
  ok <- number && is.null(dim(x)) && (if (is.null(n)) length(x) > 0 else length(x) %in% n) &&
    all((missing & is.na(x) & !is.nan(x)) | (is.finite(x) & x >= lower & x <= upper))
  if (!ok) {
    many <- if (is.null(n)) "" else paste0(paste(n, collapse = " or "), " ")
    remedy <- paste0(
      trimws(paste0("Give ", many, "finite numbers ", describe_range(lower, upper, FALSE))), "."
    )
    refuse_argument(name, x, if (missing) paste(remedy, "NA: missing.") else remedy)
  }
  as.numeric(x)
}

check_flag <- function(x, name) {
  if (!isTRUE(x) && !isFALSE(x)) refuse_argument(name, x, "Choose TRUE or FALSE.")
  invisible(x)
}

#' Arguments of one function that are TRUE or FALSE each, given as they are called there
#' @noRd
check_flags <- function(...) {
  names <- vapply(substitute(list(...))[-1], as.character, "")
  invisible(Map(check_flag, list(...), names))
}

check_choice <- function(x, choices, name) {
  if (!is.character(x) || length(x) < 1 || !x[[1]] %in% choices) {
    refuse_argument(name, x,
                    paste0("Choose one of ", paste0('"', choices, '"', collapse = ", "), "."))
  }
  x[[1]]
}

#' Some of several choices
#' @noRd
check_choices <- function(x, choices, name) {
  if (!is.character(x) || !length(x) || !all(x %in% choices)) {
    refuse_argument(name, x,
                    paste0("Choose among ", paste0('"', choices, '"', collapse = ", "), "."))
  }
  unique(x)
}

#' One string, as plain text
#' @noRd
check_text <- function(x, name, null = FALSE) {
  if (is.null(x) && null) return(NULL)
  if (!is.character(x) || length(x) != 1 || is.na(x)) {
    refuse_argument(name, x, if (null) "Give one string, or NULL." else "Give one string.")
  }
  as.character(x)
}

check_names <- function(x, name, null = FALSE) {
  if (is.null(x) && null) return(NULL)
  if (!is.character(x) || anyNA(x)) {
    refuse_argument(name, x, "Give names: strings, none of them NA.")
  }
  as.character(x)
}

#' Colours as R knows them: names, "#RRGGBB", numbers of the palette
#' @param none Whether one colour is asked for, or NA: none.
#' @noRd
check_colour <- function(x, name, none = FALSE) {
  if (none && length(x) == 1 && is.atomic(x) && is.na(x) && !is.nan(x)) return(NA)
  known <- function(x) !is.null(tryCatch(suppressWarnings(grDevices::col2rgb(x)),
                                         error = function(e) NULL))
  kind <- is.null(dim(x)) && (is.character(x) || (is.numeric(x) && all(is.finite(x) & x < 1e9)))
  if (!kind || !length(x) || (none && length(x) > 1) || anyNA(x) || !known(unique(x))) {
    refuse_argument(name, x,
                    sprintf("Give colours, such as \"black\" or \"#16218C\"%s.",
                            if (none) ", or NA" else ""))
  }
  x
}

# Colours of vertices: one, or one for each.
check_colours <- function(colour, n) {
  check_colour(colour, "colour")
  if (!length(colour) %in% c(1L, n)) {
    crestline_abort(sprintf("`colour` has %d values for %d vertices.", length(colour), n),
                    "Give one colour, or one for each vertex.", stage = "picture")
  }
  rep_len(colour, n)
}

#' An object of a class of ours, or of `mesh3d`, with the parts that it has at least
#' @noRd
check_class <- function(x, class, name, maker) {
  make <- sprintf("Make one with %s.", maker)
  if (!inherits(x, class)) {
    refuse_argument(name, x, make, sprintf(
      "%s, not of class \"%s\"", describe_value(x), class
    ))
  }
  parts <- class_parts[[class]]
  is_there <- vapply(names(parts), function(part) {
    value <- x[[part]]
    switch(parts[[part]], list = is.list(value), table = is.data.frame(value),
           numbers = is.numeric(value), id = is.character(value) && length(value) == 1,
           inherits(value, parts[[part]]))
  }, NA)
  lacks <- names(parts)[!is_there]
  if (length(lacks)) {
    refuse_argument(name, x, make, sprintf(
      "a damaged \"%s\": it has no proper %s", class, paste0("`", lacks, "`", collapse = ", ")
    ))
  }
  validate(x)
  invisible(x)
}

#' Refuse an object that breaks the rules of its class: validate_<class>() of the classes that have
#' rules
#' @noRd
validate <- function(x) UseMethod("validate")

#' Whether an object passed its rules lately
#'
#' It is known by its place in memory: R changes nothing that something else holds, so that what was
#' touched lies elsewhere.
#' @noRd
passed_lately <- function(x, class) {
  for (one in passed_objects[[class]]) if (rlang::is_reference(x, one)) return(TRUE)
  FALSE
}

passed_objects <- new.env(parent = emptyenv())

#' @param most Number of objects that are remembered: a scan, and the same with its holes bridged.
#' @noRd
remember_passed <- function(x, class, most = 2) {
  passed_objects[[class]] <- utils::head(c(list(x), passed_objects[[class]]), most)
  invisible(x)
}

#' @exportS3Method
validate.default <- function(x) invisible(x)
#' A specimen or a mesh
#' @noRd
check_surface <- function(x, name) {
  if (inherits(x, "specimen")) {
    return(check_class(x, "specimen", name, "specimen() or read_specimen()"))
  }
  check_class(x, "mesh3d", name, "specimen(), read_specimen() or `Rvcg::vcgImport()`")
}

#' Ends of a line, of which no specimen is known yet: names of landmarks, or positions, by argument
#' @noRd
check_ends <- function(...) {
  ends <- list(...)
  for (name in names(ends)) {
    x <- ends[[name]]
    has <- function(...) all(c(...) %in% names(x))
    placed <- is.data.frame(x) && nrow(x) == 1 &&
      (has("x", "y", "z") || has("face", "w1", "w2", "w3"))
    located <- is.numeric(x) && identical(names(x), mesh_columns)
    position <- placed || located || (is.numeric(x) && length(x) == 3 && all(is.finite(x)))
    if (!position && !is_path(x)) {
      refuse_argument(name, x, end_words(x, "a landmark"))
    }
  }
}

#' What an end of a line may be; a number may be meant as the name of a landmark
#' @noRd
end_words <- function(x, landmark) {
  number <- is.numeric(x) && length(x) == 1 && is.finite(x)
  sprintf("Give the name of %s%s, or three finite co-ordinates.", landmark,
          if (number) sprintf(" as text, such as \"%g\"", x) else "")
}

#' Regions in which strength does not count: one, a list of them, or NULL
#' @noRd
check_regions <- function(x, name = "keep_away") {
  if (is.null(x)) return(NULL)
  if (inherits(x, c("keep_away", "keep_side"))) x <- list(x)
  plain <- is.list(x) && !is.object(x)
  if (!plain) check_class(x, "keep_away", name, "keep_away() or keep_side()")
  for (one in x) if (!inherits(one,
                               "keep_side")) check_class(one, "keep_away", name,
                                                         "keep_away() or keep_side()")
  x
}

# The parts without which no function can use an object of the class, and what they are.
class_parts <- list(
  specimen = c(id = "id", mesh = "mesh3d", landmarks = "numbers"),
  shape = c(id = "id", points = "table", status = "table", scheme = "curve_scheme"),
  curve = c(path = "table", points = "table"),
  curve_scheme = c(landmarks = "table", curves = "table", points = "table"),
  shape_pca = c(x = "numbers", sdev = "numbers", mean = "numbers"),
  landmark_template = c(specimen = "specimen", landmarks = "numbers"),
  simulated_faces = c(template = "specimen")
)

#' A list of objects of a class; one alone counts as a list of it
#' @noRd
check_list <- function(x, class, name, maker) {
  if (inherits(x, class)) x <- list(x)
  if (!is.list(x) || is.object(x) || !length(x)) check_class(x, class, name, maker)
  for (one in x) check_class(one, class, name, maker)
  x
}

check_table <- function(x, name, null = FALSE) {
  if (is.null(x) && null) return(NULL)
  if (!is.data.frame(x)) refuse_argument(name, x, "Give a data frame.")
  x
}

check_function <- function(x, name) {
  if (!is.function(x)) refuse_argument(name, x, "Give a function.")
  x
}

#' A seed that R takes, or NULL
#' @noRd
check_seed <- function(x, name = "seed") {
  if (is.null(x)) return(NULL)
  most <- .Machine$integer.max
  as.integer(check_number(x, name, lower = -most, upper = most))
}

#' Width and height in pixels
#' @noRd
check_size <- function(x, name = "size") {
  x <- check_numbers(x, name, 2, lower = 1)
  if (prod(x) > argument_limits()$pixels) {
    refuse_argument(name, x, sprintf("Give at most %g pixels.", argument_limits()$pixels))
  }
  x
}

#' A result that is held in memory at once is not larger than the limit
#'
#' @param x,name The argument that makes it large.
#' @param numbers How many numbers of 8 bytes it holds.
#' @noRd
check_memory <- function(numbers, x, name) {
  gigabytes <- 8 * numbers / 1e9
  most <- argument_limits()$bytes / 1e9
  if (gigabytes <= most) return(invisible(x))
  refuse_argument(name, x,
                  sprintf("Give less: the result would take %.3g GB, the limit is %g.", gigabytes,
                          most))
}

#' The path of a file to be written, in a folder that exists
#' @param endings Extensions that will do, without the dot; any where NULL.
#' @noRd
check_path_to_write <- function(x, name, endings = NULL, stage = "arguments") {
  fail <- function(said, remedy) crestline_abort(
    sprintf("`%s` is %s.", name, said), remedy, stage = stage
  )
  if (!is_path(x)) fail(describe_value(x), "Give the path of one file.")
  if (!is.null(endings) && !file_extension(x) %in% endings) {
    fail(describe_value(x),
         sprintf("Give a path that ends in %s.", paste0(".", endings, collapse = ", ")))
  }
  if (dir.exists(x)) fail(sprintf("%s, a folder", x), "Give the path of a file.")
  if (!dir.exists(dirname(x))) {
    fail(sprintf("%s, in a folder that does not exist", x), "Create the folder first.")
  }
  x
}

#' Whether all arguments without a default were given
#'
#' The first line of an exported function: R's own message would come from deep inside.
#' @param but Arguments that may be left out in this call.
#' @param called What was called, for the name of its help page.
#' @noRd
check_given <- function(but = character(), frame = parent.frame(),
                        fn = sys.function(sys.parent()), called = sys.call(sys.parent())) {
  arguments <- formals(fn)
  arguments <- arguments[vapply(arguments, is.symbol, NA)]
  needed <- names(arguments)[!nzchar(vapply(arguments, as.character, ""))]
  is_missing <- function(name) eval(as.call(list(base::missing, as.name(name))), frame)
  absent <- Filter(is_missing, setdiff(needed, c("...", but)))
  if (!length(absent)) return(invisible())
  crestline_abort(sprintf("%s %s not given.", paste0("`", absent, "`", collapse = ", "),
                          if (length(absent) == 1) "is" else "are"),
                  given_words(absent, called), stage = "arguments")
}

#' What to give: the name of the help page, and a usual radius
#' @noRd
given_words <- function(absent, called) {
  name <- sub("^crestline::", "", paste(deparse(called[[1]]), collapse = ""))
  own <- is.function(get0(name, topenv(), inherits = FALSE))
  page <- if (own) sprintf("See ?%s.", name) else "See the help page of the function."
  if (!"radius" %in% absent) return(page)
  width <- if ("width" %in% absent) "; `width` is often the same" else ""
  sprintf("On a face in mm a radius is 10, or 5 at the lips%s. %s", width, page)
}

#' No argument that the function does not know
#'
#' @param ... The dots of the function that asks.
#' @param known Names that will do.
#' @noRd
check_dots <- function(..., known = character()) {
  given <- ...names()
  if (is.null(given)) given <- character(...length())
  strange <- which(!given %in% known)
  if (!length(strange)) return(invisible())
  name <- given[strange[1]]
  said <- if (nzchar(name)) sprintf("there is no argument `%s`.", name) else
    sprintf("there is no use for the argument in place %d of `...`.", strange[1])
  near <- known[order(utils::adist(name, known, ignore.case = TRUE))]
  crestline_abort(said,
                  if (length(near)) sprintf("Near names: %s.", shorten(near)) else "Leave it out.",
                  stage = "arguments")
}

#' No argument that a method of print(), as.data.frame() and the like does not know; R itself passes
#' some
#' @noRd
check_method_dots <- function(..., known = character()) {
  own <- c("digits", "quote", "right", "max", "row.names", "optional", "stringsAsFactors",
           "make.names", "check.names",
           "col.names", "nm", "cut.names", "fix.empty.names")
  strange <- setdiff(...names(), c("", own, known))
  if (length(strange)) {
    crestline_abort(sprintf("there is no argument `%s`.", strange[1]),
                    if (length(known)) {
                      sprintf("There is: %s.", shorten(known))
                    } else {
                      "Leave it out."
                    },
                    stage = "arguments")
  }
}

#' How many rows are printed; Inf: all
#' @noRd
check_most <- function(most) {
  if (!identical(most, Inf)) check_count(most, "most", lower = 0)
}

#' A call of base graphics, whose errors are said as those of the package
#' @noRd
drawn_or_refused <- function(code) {
  tryCatch(code, error = function(e) {
    crestline_abort(sprintf("the picture cannot be drawn: %s.",
                            sub("[.]$", "", conditionMessage(e))),
                    "Check the further arguments of plot().", stage = "picture", call = NULL)
  })
}

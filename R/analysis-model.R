# The design of a linear model of shape: its variables by specimen, its matrix, the spans of its
# terms.

#' A right-hand side as terms
#' @noRd
model_terms <- function(formula) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "model")
  }
  if (!inherits(formula, "formula")) {
    fail(sprintf("`formula` is %s.", describe_value(formula)), "Give one, such as ~ age + sex.")
  }
  if (length(formula) > 2) {
    fail("`formula` has a left-hand side.", "Leave it out: the response is shape.")
  }
  terms <- tryCatch(stats::terms(formula), error = function(e) {
    fail(sprintf("`formula` cannot be read: %s.", rlang::cnd_message(e)),
         "Name every variable; a `.` is not known.")
  })
  random <- function(x) is.call(x) && deparse1(x[[1]]) %in% c("|", "||", "Error")
  if (any(vapply(as.list(attr(terms, "variables"))[-1], random, NA))) {
    fail("`formula` has a random effect.",
         "Give pairs, repeats, families as `block`; else RRPP::lmm.rrpp(), vignette(\"interop\").")
  }
  if (!length(attr(terms, "term.labels"))) fail("`formula` has no term.", "Give ~ age, say.")
  if (!attr(terms, "intercept")) fail("`formula` has no intercept.", "Leave out `0` or `- 1`.")
  if (!is.null(attr(terms, "offset"))) fail("`formula` has an offset.", "Leave it out.")
  terms
}

#' The variables of a model, in the order of the specimens
#'
#' A variable comes from `data`, where rows are matched by specimen. Outside of it only constants
#' are looked for (degrees of freedom, knots): a vector from there would be matched by position.
#'
#' @return List of columns.
#' @noRd
model_data <- function(terms, data, ids) {
  # Names of the sample's own, where the formula does not ask for them.
  if (is.data.frame(data)) {
    for (name in setdiff(c("coords", "size"), all.vars(terms))) data[[name]] <- NULL
  }
  columns <- covariates(data, ids)
  outside <- setdiff(all.vars(terms), c(names(columns), "size"))
  frame <- environment(terms)
  for (name in outside) {
    value <- get0(name, envir = frame)
    if (is.null(value) || is.function(value) || NROW(value) == length(ids)) {
      crestline_abort(sprintf("`%s` of the formula is no column of `data`.", name),
                      paste("Its columns are", shorten(c(names(columns), "size")),
                            "(the centroid size); rows are matched to specimens there."),
                      stage = "model")
    }
  }
  columns
}

#' The model of one level
#'
#' @param columns As of [model_data()].
#' @param aligned Alignment of the level.
#' @return List: `terms` (with what prediction needs), `frame`, `xlev`, `contrasts`, `matrix` (n x
#'   p), `assign` (term of each column, 0 the intercept), `coefficients` (p x dk), `variables`,
#'   `ranges` (least and greatest value of each variable that is a number).
#' @noRd
level_model <- function(terms, columns, aligned, contrasts = NULL) {
  ids <- names(aligned$size)
  columns$size <- unname(aligned$size)
  used <- columns[intersect(names(columns), all.vars(terms))]
  used <- lapply(used, function(x) if (is.character(x)) factor(x) else x)
  say_single_levels(used)
  frame_data <- list2DF(used, length(ids))
  say_missing(frame_data, ids)
  say_codes(used)
  frame <- tryCatch(
    suppressWarnings(stats::model.frame(
      terms, frame_data, na.action = stats::na.pass, drop.unused.levels = TRUE
    )),
    error = function(e) refuse_formula(e)
  )
  say_missing(frame, ids)
  terms <- attr(frame, "terms")
  x <- tryCatch(stats::model.matrix(terms, frame, contrasts), error = function(e) {
    refuse_formula(e)
  })
  rownames(x) <- ids
  list(terms = terms, frame = frame, xlev = stats::.getXlevels(terms, frame),
       contrasts = attr(x, "contrasts"), matrix = x, assign = attr(x, "assign"),
       coefficients = shape_coefficients(x, aligned),
       variables = names(used), ranges = lapply(Filter(is_plain_number, used), range))
}

#' Least squares of every co-ordinate, some points at a time: of the centred ones, and what is
#' common to all is of the constant
#' @param x n x p, its first column constant.
#' @return p x dk.
#' @noRd
shape_coefficients <- function(x, aligned) {
  parts <- qr(x, tol = 1e-7)
  k <- nrow(aligned$mean)
  beta <- matrix(0, ncol(x), length(aligned$mean), dimnames = list(colnames(x), NULL))
  for (rows in point_chunks(aligned)) {
    each <- columns_of_points(aligned, rows)
    for (d in seq_along(each)) beta[, (d - 1) * k + rows] <- qr.coef(parts, each[[d]])
  }
  n <- length(aligned)
  beta[1, ] <- beta[1, ] + as.vector(weighted_shape(aligned, rep(1 / n, n)))
  beta
}

is_plain_number <- function(x) is.numeric(x) && length(dim(x)) < 2

#' Stops where a factor has one level only
#' @noRd
say_single_levels <- function(used) {
  single <- function(x) !is.numeric(x) && length(unique(x[!is.na(x)])) == 1
  for (name in names(used)[vapply(used, single, NA)]) {
    crestline_abort(sprintf("`%s` has one level only (%s).", name,
                            as.character(used[[name]][!is.na(used[[name]])][1])),
                    "Leave it out of the formula.", stage = "model")
  }
}

refuse_formula <- function(e) {
  crestline_abort(sprintf("the model cannot be built: %s.", sub("[.]$", "", conditionMessage(e))),
                  "Check the formula, and the columns of `data`.", stage = "model")
}

#' Whole numbers of few values may be codes of groups
#'
#' @param most Greatest number of distinct values that may be codes.
#' @noRd
say_codes <- function(used, most = 4) {
  coded <- function(x) is_plain_number(x) && length(unique(x)) <= most && all(x == round(x)) &&
    length(x) > 2 * most
  for (name in names(used)[vapply(used, coded, NA)]) {
    crestline_inform(sprintf(
      "`%s` is taken as a number (%s): if these are groups, give factor(%s).",
      name, toString(sort(unique(used[[name]]))), name
    ))
  }
}

range_text <- function(x) paste(signif(x, 4), collapse = " to ")

#' Names of specimens as R writes them, the first ones only
#' @noRd
quoted_ids <- function(ids, most = 3) {
  if (length(ids) > most) return("...")
  if (length(ids) == 1) return(dQuote(ids, FALSE))
  sprintf("c(%s)", paste(dQuote(ids, FALSE), collapse = ", "))
}

#' Stops where a variable is missing or infinite, and names the specimens
#' @noRd
say_missing <- function(frame, ids, sample = TRUE) {
  for (name in names(frame)) {
    value <- frame[[name]]
    absent <- if (is.numeric(value)) !is.finite(value) else is.na(value)
    if (is.matrix(absent)) absent <- rowSums(absent) > 0
    if (any(absent)) {
      crestline_abort(sprintf("`%s` is missing or infinite for %s.", name, shorten(ids[absent])),
                      paste0("Give these values", if (sample) paste0(
                        ", or leave these specimens out: sample[setdiff(names(sample), ",
                        quoted_ids(ids[absent]), ")]"), "."),
                      stage = "model")
    }
  }
}

#' Columns of the terms that a term is tested with and without
#'
#' Type I: those before it. Type II: all that do not contain it. Type III: all others.
#'
#' @return List of two logical vectors over the columns of the matrix: `without`, `with`.
#' @noRd
tested_columns <- function(model, term, ss) {
  assign <- model$assign
  if (ss == "I") return(list(without = assign < term, with = assign <= term))
  if (ss == "III") return(list(without = assign != term, with = rep(TRUE, length(assign))))
  shared <- crossprod(attr(model$terms, "factors"))[, term]
  kept <- c(0, which(shared < shared[term]))
  list(without = assign %in% kept, with = assign %in% c(kept, term))
}

#' An orthonormal basis of some columns, the first of them first
#'
#' @param tolerance Of [base::qr()]: below this share of its length left, a column is a sum of those
#'   before it (that of [stats::lm()]).
#' @noRd
orthonormal <- function(x, tolerance = 1e-7) {
  parts <- qr(x, tol = tolerance)
  qr.Q(parts)[, seq_len(parts$rank), drop = FALSE]
}

#' What a term adds to a model
#'
#' @return List: `without` (n x r, orthonormal, of the model without it), `basis` (n x p - 1, of the
#'   whole model, square to the mean, the term's own `df` columns first), `df`, `left` (residual
#'   degrees of freedom of the whole model), `column` (n, the term's only column, NULL where it has
#'   more or is not estimated alone).
#' @noRd
term_span <- function(model, term, ss) {
  x <- model$matrix
  columns <- tested_columns(model, term, ss)
  without <- orthonormal(x[, columns$without, drop = FALSE])
  both <- orthonormal(cbind(without, x[, columns$with, drop = FALSE]))
  df <- ncol(both) - ncol(without)
  own <- both[, ncol(without) + seq_len(df), drop = FALSE]
  basis <- orthonormal(cbind(1, own, x))
  list(without = without, basis = basis[, -1, drop = FALSE], df = df, left = nrow(x) - ncol(basis),
       column = if (sum(model$assign == term) == 1) x[, model$assign == term])
}

#' The spans of all terms by name; stops where one adds nothing
#' @noRd
term_spans <- function(model, ss) {
  labels <- attr(model$terms, "term.labels")
  spans <- lapply(stats::setNames(seq_along(labels), labels),
                  function(term) term_span(model, term, ss))
  empty <- labels[vapply(spans, function(span) span$df == 0, NA)]
  if (length(empty)) {
    crestline_abort(sprintf("the term %s adds nothing to the others.", shorten(empty)),
                    "Leave it out: it is constant, or follows from other terms.", stage = "model")
  }
  if (spans[[1]]$left < 1) {
    crestline_abort(sprintf("the model has as many coefficients as there are specimens (%d).",
                            nrow(model$matrix)),
                    "Give fewer terms, or more specimens.", stage = "model")
  }
  spans
}

#' That new values are there, and are numbers where the model has numbers; a warning of those
#' outside of the sample's
#' @noRd
check_new_values <- function(model, newdata) {
  fail <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "model")
  }
  absent <- setdiff(model$variables, names(newdata))
  if (length(absent)) {
    sizes <- if (absent[1] == "size") sprintf(" The centroid sizes of this level are %s.",
                                              range_text(model$ranges$size))
    fail(sprintf("`newdata` has no column `%s`.", absent[1]),
         paste0("The model's variables are ", shorten(model$variables), ".", sizes))
  }
  for (name in names(model$ranges)) {
    value <- newdata[[name]]
    if (!is.numeric(value)) {
      fail(sprintf("`%s` of `newdata` is %s; the model has numbers.", name, describe_value(value)),
           "Give numbers.")
    }
    own <- model$ranges[[name]]
    out <- is.finite(value) & (value < own[1] - 1e-8 * abs(own[1]) |
                                 value > own[2] + 1e-8 * abs(own[2]))
    if (any(out)) {
      crestline_warn(
        sprintf("`%s` of `newdata` is %s; the sample has %s%s.", name,
                shorten(signif(value[out], 4)), range_text(own),
                if (name == "size") " (centroid sizes of this level)" else ""),
        "The shape is extrapolated there: nothing in the sample supports it.",
        stage = "model", class = "crestline_extrapolated"
      )
    }
  }
}

#' Matrix of a model at new values
#'
#' @return n x p, a row a row of `newdata`.
#' @noRd
model_at <- function(model, newdata) {
  terms <- stats::delete.response(model$terms)
  check_new_values(model, newdata)
  rows <- if (is.null(rownames(newdata))) seq_len(nrow(newdata)) else rownames(newdata)
  say_missing(newdata[model$variables], rows, sample = FALSE)
  frame <- tryCatch(
    stats::model.frame(terms, newdata, na.action = stats::na.pass, xlev = model$xlev),
    error = function(e) refuse_formula(e)
  )
  say_missing(frame, rows, sample = FALSE)
  x <- stats::model.matrix(terms, frame, model$contrasts)
  known <- qr(t(model$matrix))
  off <- sqrt(rowSums(t(qr.resid(known, t(x)))^2) / rowSums(x^2))
  if (any(off > 1e-6)) {
    crestline_abort(sprintf("row %s of `newdata` is a combination of which the sample has nothing.",
                            shorten(which(off > 1e-6))),
                    "Predict only where the model's coefficients are estimated.", stage = "model")
  }
  x
}

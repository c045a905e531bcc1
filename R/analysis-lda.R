# Discriminant analysis of groups on principal components, its error by leaving one out.

#' Classify specimens by shape (linear discriminant analysis)
#'
#' Makes a linear discriminant analysis (`MASS::lda()`) on the first principal components, and
#' estimates its error by cross-validation. Each specimen in turn is left out. The others are
#' aligned, their components are found, and the number of components is chosen. The specimen is then
#' superimposed on their mean and assigned to a group. An alignment of the whole sample would use
#' the specimen itself, and the error would be underestimated.
#'
#' @param sample As in [compare_groups()]; one level of it.
#' @param group Factor of n, as in [compare_groups()].
#' @param components Numbers of components among which one is chosen: the number with the fewest
#'   errors of `MASS::lda(CV = TRUE)` on the training specimens, and of several the least. One
#'   number: this number is used. Numbers that leave the training specimens no degree of freedom are
#'   not used.
#' @param level Level of a `shape_sample`, as in [align()].
#' @param prior Prior probabilities of the groups, in the order of their levels. `NULL`: their
#'   shares of the sample.
#' @param scale,weights,missing,progress As in [compare_groups()].
#' @return Object of class `shape_lda`, a list:
#'   * `specimens`: data frame with a row for each specimen: `id`, `group`, `predicted`, `correct`,
#'     `components` (number chosen). Prediction and choice do not use the specimen;
#'   * `posterior`: n x g matrix, posterior probabilities of the groups, by the model without the
#'     specimen;
#'   * `confusion`: table, true groups by predicted groups; `error`: share of wrong assignments;
#'     `chance`: error of always choosing the most frequent group;
#'   * `lda` (of `MASS`), `pca`, `components`: fitted to all specimens, for the prediction of new
#'     ones;
#'   * `group`, `prior`, `candidates`.
#'
#'   `as.data.frame()` gives `specimens`. `predict(lda, newdata)` takes new shapes as
#'   [predict.shape_pca()] does. It returns a list: `class` (factor), `posterior` (m x g), `x`
#'   (discriminant scores), with the names of the shapes.
#' @section Errors: of class `crestline_error`: those of [compare_groups()]; a group has fewer than
#'   three specimens; no number of components is left.
#' @template glossary
#' @references Kovarovic, Aiello, Cardini and Lockwood (2011) Discriminant function analyses in
#'   archaeology: are classification rates too good to be true? *Journal of Archaeological Science*
#'   38, 3006-3018; Venables and Ripley (2002) *Modern Applied Statistics with S*, section 12.1.
#' @seealso [compare_groups()], [predict.shape_pca()]
#' @examples
#' shapes <- array(rep(c(0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1), 20), c(4, 3, 20))
#' shapes <- shapes + rnorm(240, sd = 0.05)
#' sex <- rep(c("F", "M"), each = 10)
#' shapes[1, 3, sex == "M"] <- shapes[1, 3, sex == "M"] + 0.15
#' fit <- shape_lda(shapes, sex, components = 1:4)
#' fit
#' predict(fit, shapes[, , 3])$posterior
#' @export
shape_lda <- function(sample, group, components = 1:10, level = "landmarks", prior = NULL,
                      scale = TRUE, weights = NULL, missing = c("estimate", "drop", "stop"),
                      progress = interactive()) {
  check_given()
  check_flags(progress)
  components <- unique(check_numbers(components, "components", lower = 1))
  if (!inherits(sample, "shape_sample")) level <- check_text(level, "level") else
    level <- check_choice(level, sample_levels, "level")
  aligned <- aligned_levels(sample, level, scale, weights, missing)[[1]]
  group <- check_group(group, names(aligned))
  few <- names(which.min(table(group)))
  if (min(table(group)) < 3) {
    crestline_abort(sprintf("the group \"%s\" has two specimens.", few),
                    "Give every group three or more: one is left out.", stage = "comparison")
  }
  prior <- check_prior(prior, group)
  each <- left_out(aligned, group, components, prior, progress)
  posterior <- t(vapply(each, `[[`, numeric(nlevels(group)), "posterior"))
  dimnames(posterior) <- list(names(group), levels(group))
  predicted <- factor(vapply(each, `[[`, "", "class"), levels(group))
  whole <- fit_lda(aligned, group, components, prior)
  structure(c(list(specimens = data.frame(
                     id = names(group), group = unname(group), predicted = predicted,
                     correct = predicted == group, components = vapply(each, `[[`, 0, "components")
                   ),
                   posterior = posterior,
                   confusion = table(group = unname(group), predicted = predicted),
                   error = mean(predicted != group),
                   chance = 1 - max(table(group)) / length(group)),
              whole,
              list(group = group, prior = prior, candidates = components, level = aligned$level,
                   provenance = with_settings(
                     aligned$provenance, "lda", list(components = components)
                   ))),
            class = "shape_lda")
}

#' Each specimen assigned by an alignment, components and discriminants that never had it
#' @return List by specimen: `class`, `posterior`, `components` (number chosen).
#' @noRd
left_out <- function(aligned, group, components, prior, progress) {
  tick <- comparison_ticks(progress, length(group))
  raw <- raw_configurations(aligned)
  lapply(seq_along(group), function(i) {
    tick()
    fit <- fit_lda(aligned[-i], group[-i], components, prior)
    one <- raw[, , i, drop = FALSE]
    found <- suppressMessages(classes_of(fit, one), "crestline_message")
    list(class = as.character(found$class), posterior = found$posterior[1, ],
         components = fit$components)
  })
}

check_prior <- function(prior, group) {
  if (is.null(prior)) {
    return(stats::setNames(as.vector(table(group)) / length(group), levels(group)))
  }
  if (!is.numeric(prior) || length(prior) != nlevels(group) || !all(is.finite(prior) & prior > 0) ||
      (!is.null(names(prior)) && !setequal(names(prior), levels(group)))) {
    refuse_argument("prior", prior,
                    sprintf("Give a number above 0 for each of %s.", shorten(levels(group))))
  }
  if (!is.null(names(prior))) prior <- prior[levels(group)]
  stats::setNames(prior / sum(prior), levels(group))
}

#' Discriminants of aligned specimens, on the number of components that errs least among them
#' @return List: `lda`, `pca`, `components`.
#' @noRd
fit_lda <- function(aligned, group, candidates, prior) {
  pca <- shape_pca(aligned)
  # One more is left out when the number is chosen.
  most <- min(length(pca$sdev), length(group) - nlevels(group) - 2)
  candidates <- candidates[candidates <= most]
  if (!length(candidates)) {
    crestline_abort("`components` are more than the specimens allow.",
                    sprintf("Give numbers of at most %d.", most), stage = "comparison")
  }
  group <- unname(group)
  discriminate <- function(count, ...) {
    MASS::lda(unit_scores(pca$x, pca, count), group, prior = unname(prior), ...)
  }
  wrong <- if (length(candidates) > 1) vapply(candidates, function(count) {
    mean(is.na(own <- discriminate(count, CV = TRUE)$class) | own != group)
  }, 0) else 0
  best <- min(candidates[wrong <= min(wrong) + 1e-12])
  list(lda = discriminate(best), pca = pca, components = best)
}

classes_of <- function(fit, newdata) {
  scores <- predict.shape_pca(fit$pca, newdata)
  # A fit that was read from a file needs the method of MASS, which nothing has loaded yet.
  loadNamespace("MASS")
  stats::predict(fit$lda, unit_scores(scores, fit$pca, fit$components))
}

#' The first scores in standard deviations: lda() takes columns of small variance for constants
#' @noRd
unit_scores <- function(scores, pca, count) {
  scores[, seq_len(count), drop = FALSE] / rep(pca$sdev[seq_len(count)], each = nrow(scores))
}

#' @rdname shape_lda
#' @param object,x A `shape_lda`.
#' @param newdata As in [predict.shape_pca()]. `NULL`: the specimens of the sample, with which the
#'   discriminants were fitted.
#' @param ... Ignored.
#' @export
predict.shape_lda <- function(object, newdata = NULL, ...) {
  check_method_dots(...)
  validate(object)
  classes_of(object, newdata)
}

#' @exportS3Method
validate.shape_lda <- function(x) {
  table <- x$specimens
  columns <- c("id", "group", "predicted", "correct")
  right <- is.data.frame(table) && all(columns %in% names(table)) &&
    inherits(x$lda, "lda") && inherits(x$pca, "shape_pca") && is.numeric(x$components) &&
    is.matrix(x$posterior) && nrow(x$posterior) == nrow(table)
  if (!right) {
    crestline_abort("the discriminant analysis is damaged: its parts do not fit together.",
                    "Make it anew: shape_lda().", stage = "comparison", call = NULL)
  }
  validate(x$pca)
  invisible(x)
}

#' @rdname shape_lda
#' @param row.names,optional Ignored.
#' @export
as.data.frame.shape_lda <- function(x, row.names = NULL, optional = FALSE, ...) {
  check_method_dots(...)
  validate(x)
  x$specimens
}

#' @export
print.shape_lda <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    n <- nrow(x$specimens)
    chosen <- range(x$specimens$components)
    cat("<shape_lda> ", amount(n, "specimen"), ", ", x$level, "; ",
        amount(x$components, "component"),
        if (length(x$candidates) > 1) {
          sprintf(" (chosen; without one specimen %s)", paste(unique(chosen), collapse = " to "))
        },
        "\n", sep = "")
    cat(sprintf("  left out and assigned: %d of %d right (%.0f %%; most frequent group: %.0f %%)\n",
                sum(x$specimens$correct), n, 100 * (1 - x$error), 100 * (1 - x$chance)))
    cat(paste0("  ", utils::capture.output(print(x$confusion))), sep = "\n")
    invisible(x)
  })
}

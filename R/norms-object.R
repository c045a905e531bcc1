# A norm as an object: its parts, its rules, what it prints.

#' A norm from what was fitted and held out
#'
#' @param made,plan As in [fit_parts()].
#' @param parts Of [fit_parts()]; `held` of [cross_validated()].
#' @noRd
new_shape_norms <- function(made, parts, held, plan, settings) {
  people <- made$people
  components <- paste("component", seq_len(plan$components))
  table <- data.frame(name = c(colnames(made$values), components),
                      transform = c(made$transform, rep("as is", plan$components)), se_norm = 0)
  skew <- skew_table(held$z)
  z <- straightened(held$z, skew)
  parts$surface$scan <- scan_limits(held$surface$t, parts$surface, people, plan)
  parts$surface$rough <- signif(stats::median(held$surface$rough), 6)
  parts$surface$healing <- healing_table(parts$surface, held$surface$u, plan$radii)
  if (!is.null(parts$asymmetry)) {
    parts$asymmetry$scan <- scan_limits(held$asymmetry$t, parts$asymmetry, people, plan)
    parts$asymmetry$rough <- signif(stats::median(held$asymmetry$rough), 6)
  }
  n <- length(people$age)
  measured <- which(!colnames(z) %in% c("size", components))
  limits <- list(map = limit_quantiles(held$map),
                 components = limit_quantiles(rowSums(z[, components, drop = FALSE]^2)),
                 measurements = if (length(measured)) {
                   limit_quantiles(apply(abs(z[, measured, drop = FALSE]), 1, max))
                 })
  effective <- effective_faces(parts, people$age, people$group)
  attack <- privacy_figures(held$privacy)
  each <- lapply(split(people$age, people$group), range)
  age_ranges <- data.frame(sex = names(each), from = ceiling(10 * vapply(each, `[`, 0, 1)) / 10,
                           to = floor(10 * vapply(each, `[`, 0, 2)) / 10, row.names = NULL)
  structure(
    list(points = cbind(made$points, joint_correlations(held$surface$u)),
         triangles = made$triangles, n = n, ages = age_ranges,
         counts = year_counts(people), names = people$names, measurements = made$table,
         table = cbind(table, skew), values = parts$values, surface = parts$surface,
         asymmetry = parts$asymmetry, limits = limits,
         privacy = c(attack[1, c("ratio", "auc")], list(
           least = signif(min(effective), 4), closest = signif(closest_faces(made$y)$ratio, 4)
         )),
         settings = unclass(settings), scheme = NULL, about = list(),
         cache = new.env(parent = emptyenv())),
    class = "shape_norms"
  )
}

year_counts <- function(people) {
  count <- as.data.frame(table(sex = people$group, year = floor(people$age)),
                         stringsAsFactors = FALSE)
  count$year <- as.integer(count$year)
  count <- count[count$Freq > 0, ]
  data.frame(sex = count$sex, from = count$year, to = count$year + 1L, n = count$Freq,
             row.names = NULL)[order(count$sex, count$year), ]
}

#' Counts below 5 merged with the next years
#' @noRd
merged_counts <- function(counts, least = 5) {
  each <- lapply(split(counts, counts$sex), function(one) {
    kept <- NULL
    for (i in seq_len(nrow(one))) {
      small <- NROW(kept) && kept$n[nrow(kept)] < least
      if (small) {
        kept$n[nrow(kept)] <- kept$n[nrow(kept)] + one$n[i]
        kept$to[nrow(kept)] <- one$to[i]
      } else {
        kept <- rbind(kept, one[i, ])
      }
    }
    last <- nrow(kept)
    if (last > 1 && kept$n[last] < least) {
      kept$n[last - 1] <- kept$n[last - 1] + kept$n[last]
      kept$to[last - 1] <- kept$to[last]
      kept <- kept[-last, ]
    }
    kept
  })
  merged <- do.call(rbind, unname(each))
  rownames(merged) <- NULL
  merged
}

#' Effective number of faces behind the mean at an age: 1 over the leverage
#'
#' @param parts List with `values` (size first) and `surface`.
#' @param share Quantile of the leverages of points that counts.
#' @noRd
effective_faces <- function(parts, age, group, share = 0.5) {
  size <- expected_columns(parts$values, age, group)$h[, 1]
  h <- expected_columns(parts$surface$columns, age, group)$h
  points <- apply(h, 1, stats::quantile, share, names = FALSE)
  1 / pmax(size, points)
}

#' Four numbers a column of the sinh-arcsinh transformation of held-out z, NA where there is none
#'
#' A skewness g puts 0.025 +- 0.028 g beyond 1.96 (Cornish and Fisher), so that 0.2 is too much for
#' tails of 0.02 to 0.03.
#'
#' @param errors Standard errors of a skewness, sqrt(6 / n), from which on it is used.
#' @param fewest Number of faces from which it is used.
#' @noRd
skew_table <- function(z, errors = 2, fewest = 500) {
  found <- matrix(NA_real_, ncol(z), 4, dimnames = list(NULL, paste0("skew_", 1:4)))
  centred <- sweep(z, 2, colMeans(z))
  skewness <- colMeans(centred^3) / colMeans(centred^2)^1.5
  skew <- abs(skewness) > errors * sqrt(6 / nrow(z)) & nrow(z) >= fewest
  for (j in which(skew)) found[j, ] <- fit_skew(z[, j])
  as.data.frame(found)
}

#' Place, scale, skewness and tail of a sinh-arcsinh distribution by maximum likelihood (Jones and
#' Pewsey)
#' @noRd
fit_skew <- function(z) {
  loss <- function(p) {
    x <- (z - p[1]) / exp(p[2])
    inner <- exp(p[4]) * asinh(x) - p[3]
    s <- sinh(inner)
    -sum(p[4] + log(cosh(inner)) - 0.5 * log1p(x^2) - s^2 / 2 - p[2])
  }
  found <- stats::optim(c(0, 0, 0, 0), loss, method = "BFGS", control = list(maxit = 500))
  if (found$convergence != 0) return(rep(NA_real_, 4))
  signif(c(found$par[1], exp(found$par[2]), found$par[3], exp(found$par[4])), 8)
}

#' z after the transformation of its column
#' @noRd
straightened <- function(z, skew) {
  for (j in which(!is.na(skew$skew_1))) {
    p <- unlist(skew[j, paste0("skew_", 1:4)])
    z[, j] <- sinh(p[4] * asinh((z[, j] - p[1]) / p[2]) - p[3])
  }
  z
}

#' The rule of components
#' @noRd
check_shared_components <- function(plan, n) {
  most <- n %/% 50
  if (plan$components > most) {
    crestline_abort(sprintf("%s of %d faces are too many to share: at most %d (a fiftieth).",
                            amount(plan$components, "component"), n, most),
                    sprintf("Give more faces, or norm_settings(components = %d).", max(most, 1)),
                    stage = "norms", class = "crestline_privacy")
  }
}

#' The rule of lone people
#'
#' The splines themselves would publish a face that decides much of the mean at its age: in
#' simulations the mean at the age of one man beyond all others is nearer to his face than to the
#' true mean; of five it is not.
#'
#' @param parts Of [fit_parts()]; `ids` of the faces.
#' @param lone Least effective number of faces at the age of a face.
#' @noRd
check_lone <- function(parts, people, ids, lone = 5) {
  effective <- effective_faces(parts, people$age, people$group)
  alone <- which(effective < lone)
  if (!length(alone)) return(invisible())
  crestline_abort(
    sprintf(paste("a lone person would be published: %s at whose age the effective number is %.2g",
                  "(least %g)."), amount(length(alone), "face"), min(effective), lone),
    sprintf("Leave out of `sample`: %s.", shorten(ids[alone], 10)), stage = "norms",
    class = "crestline_privacy"
  )
}

#' The two faces that differ least
#'
#' @param y n x 3k: co-ordinates of laid faces.
#' @param most Co-ordinates that are compared at most.
#' @param usual Quantile of the differences that is the usual one: of a person who is most of the
#'   sample the median would be that of copies.
#' @return List: `ratio` (their difference, root mean square, over the usual one of all pairs),
#'   `apart` (n x n: all such ratios, NA of a face with itself).
#' @noRd
closest_faces <- function(y, most = 300, usual = 0.9) {
  columns <- unique(round(seq(1, ncol(y), length.out = min(most, ncol(y)))))
  apart <- as.matrix(stats::dist(y[, columns]))
  diag(apart) <- NA
  apart <- apart / stats::quantile(apart, usual, na.rm = TRUE, names = FALSE)
  list(ratio = min(apart, na.rm = TRUE), apart = apart)
}

#' The rule of copies: who is in a sample more than once counts as several in all other rules
#'
#' In simulations the two most alike of 1,500 people differ by 0.25 of the usual difference, two
#' scans of one person by 0.05.
#'
#' @param closest Of [closest_faces()], or its `ratio` (NULL in a norm of a former version).
#' @param ids Names of the faces, NULL if they are no longer known.
#' @param least Least ratio.
#' @noRd
check_copies <- function(closest, ids = NULL, least = 0.15) {
  refuse <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "norms", class = "crestline_privacy")
  }
  if (is.null(closest)) {
    refuse("the norm does not say whether a person is in it twice.",
           "Fit it again by this crestline, with share = TRUE.")
  }
  ratio <- if (is.list(closest)) closest$ratio else closest
  if (ratio >= least) return(invisible())
  said <- "two faces are copies, or of one person: they differ by %.2g of the usual (least %g)."
  twins <- if (is.list(closest)) which(closest$apart < least, arr.ind = TRUE)
  again <- unique(twins[twins[, 1] > twins[, 2], 1])
  refuse(sprintf(said, ratio, least), if (length(ids)) {
    sprintf("Leave out of `sample`: %s.", shorten(ids[again], 10))
  } else "Fit it with one face of each person; fit_norms(share = TRUE) names the others.")
}

#' The rule of ages, at every age that is kept: also between those of the faces
#' @param step Of the ages, to which they are rounded.
#' @noRd
check_shared_ages <- function(norms, least = 10, step = 0.1) {
  for (i in seq_len(nrow(norms$ages))) {
    ages <- norms$ages[i, ]
    age <- seq(ages$from, ages$to, by = step)
    effective <- effective_faces(norms, age, rep(ages$sex, length(age)))
    at <- which.min(effective)
    if (effective[at] < least) {
      crestline_abort(
        sprintf("at %.3g (%s) the mean is decided by %.2g faces (least %g).", age[at], ages$sex,
                effective[at], least),
        "fit_norms(share = TRUE) cuts ages at the ends. For a gap between ages, give more faces.",
        stage = "norms", class = "crestline_privacy"
      )
    }
  }
}

#' A norm whose ages are cut at the ends where few faces are effective
#'
#' `least` of its privacy is that of all ages that are left: also of a gap between them, and of a
#' sex of which no age would be left.
#' @noRd
keep_shared_ages <- function(norms, people, least = 10) {
  effective <- effective_faces(norms, people$age, people$group)
  kept <- effective >= least
  before <- norms$ages
  for (i in seq_len(nrow(norms$ages))) {
    own <- people$age[kept & people$group == norms$ages$sex[i]]
    if (!length(own)) next
    norms$ages[i, c("from", "to")] <- c(ceiling(10 * min(own)), floor(10 * max(own))) / 10
  }
  for (i in which(norms$ages$from != before$from | norms$ages$to != before$to)) {
    said <- "Ages of %s cut to %.3g to %.3g (sample: %.3g to %.3g): beyond, fewer than %g count."
    crestline_inform(sprintf(said, norms$ages$sex[i], norms$ages$from[i], norms$ages$to[i],
                             before$from[i], before$to[i], least))
  }
  row <- match(people$group, norms$ages$sex)
  left <- people$age >= norms$ages$from[row] & people$age <= norms$ages$to[row]
  norms$privacy$least <- if (any(left)) signif(min(effective[left]), 4) else 0
  norms
}

#' The rules of ages and of membership
#'
#' @param least Least effective number of faces at any age.
#' @param ratio,auc Limits of the attack.
#' @param fewer What files of fewer components would tell, of [privacy_figures()], or NULL.
#' @noRd
check_shared <- function(norms, fewer = NULL, least = 10, ratio = 0.95, auc = 0.60) {
  refuse <- function(problem, remedy) {
    crestline_abort(problem, remedy, stage = "norms", class = "crestline_privacy")
  }
  own <- norms$privacy
  if (own$least < least) {
    refuse(sprintf("at some age that is kept the mean is decided by %.2g faces (least %g).",
                   own$least, least),
           paste("fit_norms(share = TRUE) cuts ages at the ends. For a gap between ages, or a sex",
                 "with few faces, give more faces."))
  }
  if (own$ratio < ratio || own$auc > auc) {
    said <- "members can be told from strangers: ratio %.3f (least %g), area %.3f (most %g)."
    good <- fewer[fewer$ratio >= ratio & fewer$auc <= auc, ]
    refuse(sprintf(said, own$ratio, ratio, own$auc, auc), if (NROW(good)) {
      sprintf("Give norm_settings(components = %d): ratio %.3f, area %.3f.", good$components[1],
              good$ratio[1], good$auc[1])
    } else "Give more faces, or keep this norm in your laboratory: fewer components do not help.")
  }
  said <- "Privacy: ratio %.3f, area under the curve %.3f, least effective number %.3g."
  crestline_inform(sprintf(said, own$ratio, own$auc, own$least))
}

#' The rules of a norm
#' @noRd
validate_shape_norms <- function(x) {
  parts <- c("points", "n", "ages", "counts", "table", "values", "surface", "limits", "settings",
             "scheme")
  # Norms of former versions have no healing, no correlations, and no kernel of the other side.
  ok <- is.list(x) && all(parts %in% names(x)) && is.data.frame(x$points) &&
    is.data.frame(x$surface$healing) && all(c("r_xy", "r_xz", "r_yz") %in% names(x$points)) &&
    is.data.frame(x$table) && is.environment(x$cache) &&
    length(x$surface$sd) == 3 * nrow(x$points) &&
    length(x$surface$mirrored) == length(x$surface$ranges) &&
    nrow(x$table) == length(x$values$groups[[1]]$lambda)
  if (!isTRUE(ok)) {
    crestline_abort("the norm is damaged, or of a former version.",
                    "Make it with fit_norms() or read_norms().",
                    stage = "norms", call = NULL)
  }
  invisible(x)
}

#' @exportS3Method
validate.shape_norms <- function(x) validate_shape_norms(x)

#' @export
print.shape_norms <- function(x, ...) {
  check_method_dots(...)
  printed(x, {
    cat("<shape_norms> ", if (length(x$about$name)) paste0(x$about$name, ": "),
        amount(x$n, "face"), ", scheme ", x$scheme$name, "\n", sep = "")
    for (i in seq_len(nrow(x$ages))) {
      cat(sprintf("  %s: %.3g to %.3g years\n", x$ages$sex[i], x$ages$from[i], x$ages$to[i]))
    }
    cat(sprintf("  size, %s, %s, %s%s\n", amount(NROW(x$measurements), "measurement"),
                amount(length(x$surface$values), "component"),
                amount(nrow(x$points), "surface point"),
                if (is.null(x$asymmetry)) "" else ", asymmetry"))
    cat(sprintf("  least effective number at an age of the sample: %.3g (below %g is refused)\n",
                x$privacy$least, x$settings$least))
    cat(sprintf("  told from strangers: ratio %.3f, area under the curve %.3f\n", x$privacy$ratio,
                x$privacy$auc))
    invisible(x)
  })
}

#' @export
summary.shape_norms <- function(object, ...) {
  check_method_dots(...)
  lines <- c(printed_lines(object), vapply(names(object$about), function(name) {
    paste0("  ", name, ": ", object$about[[name]])
  }, ""))
  structure(list(lines = lines, counts = object$counts), class = "norms_summary")
}

#' @export
print.norms_summary <- function(x, ...) {
  cat(x$lines, sep = "\n")
  print(x$counts, row.names = FALSE)
  invisible(x)
}

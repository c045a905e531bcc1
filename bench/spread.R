# Level and power of the tests of groups, where groups differ in size and spread.
#
#   nice Rscript bench/spread.R [samples] [file] [part]
#
# part: variants, bound, size, level, three, chance, form, power or designs; all but chance if not
# given.
#
# A sample: shapes of 20 points about one mean, of eight modes of falling variance and noise, all
# in the space tangent to the shapes at the mean, so that means are equal whatever the spread;
# normal centroid sizes. Groups after the first have `ratio` times the first one's spread. 99
# permutations. Adds a row a sample to `file` as it goes (columns: what, sizes, ratio, spread, seed,
# and the p-values), goes on where it stopped, and prints the shares of p-values up to 0.05.
# level, three: two groups, and three. chance: equal groups of equal spread alone, for more samples.
# form: the spreads differ in the first mode only, or in the noise only. variants: of one variable,
# what raising a group's variance costs and gains, 100,000 samples. bound: the greatest power that
# any test of one variable can have. size: level and power of the test of size alone, for more
# samples.

library(crestline)

argument <- commandArgs(TRUE)
samples <- if (length(argument) > 0) as.integer(argument[1]) else 500L
file <- if (length(argument) > 1) argument[2] else file.path(tempdir(), "spread.csv")
wanted <- if (length(argument) > 2) argument[3] else
  c("variants", "bound", "size", "level", "three", "form", "power", "designs")

# Deviations in the tangent space at `mean` (k x 3, centred, of unit size).
tangent_to <- function(mean) {
  turn <- sapply(list(1:2, c(1, 3), 2:3), function(pair) {
    moved <- 0 * mean
    moved[, pair[1]] <- -mean[, pair[2]]
    moved[, pair[2]] <- mean[, pair[1]]
    as.vector(moved)
  })
  off <- qr(cbind(as.vector(mean), turn, kronecker(diag(3), rep(1, nrow(mean)))))
  function(x) matrix(qr.resid(off, as.vector(x)), nrow(mean))
}

# `effect`: of shape at four points (unit of centroid size), and of size (share).
# `form`: of what differs by `ratio`.
draw_groups <- function(sizes, ratio, seed, effect = c(0, 0), spread = 0.02, k = 20, form = "all") {
  set.seed(seed)
  mean <- scale(matrix(rnorm(3 * k), k), scale = FALSE)
  mean <- mean / sqrt(sum(mean^2))
  tangent <- tangent_to(mean)
  sd <- spread / sqrt(3 * k)
  modes <- replicate(8, tangent(matrix(rnorm(3 * k), k)), simplify = FALSE)
  modes <- Map(`*`, modes, 2 * sd * 0.8^(0:7))
  bump <- tangent(replace(0 * mean, cbind(1:4, 3), 1))
  group <- rep(seq_along(sizes), sizes)
  own <- c(1, rep_len(ratio, length(sizes) - 1))[group]
  shapes <- lapply(seq_along(group), function(i) {
    noise <- 0.7 * sd * tangent(matrix(rnorm(3 * k), k))
    if (form != "first") noise <- own[i] * noise
    of_modes <- rep(if (form == "noise") 1 else own[i], 8)
    if (form == "first") of_modes[-1] <- 1
    off <- Reduce(`+`, Map(`*`, modes, of_modes * rnorm(8))) + noise
    shape <- mean + off + effect[1] * (group[i] == 2) * bump
    size <- 1 + 0.04 * own[i] * rnorm(1) + effect[2] * (group[i] == 2)
    size * shape / sqrt(sum(shape^2))
  })
  list(x = simplify2array(shapes), group = factor(letters[group]))
}

p_values <- function(data, seed, ..., tests = comparison_settings()$tests) {
  compared <- suppressMessages(suppressWarnings(
    compare_groups(data$x, data$group, n_perm = 99, seed = seed, progress = FALSE, ...,
                   settings = comparison_settings(tests = tests, exact = 0, n_boot = 1))
  ))
  tests <- compared$tests
  least <- function(p) if (length(p)) min(p) else NA
  p <- function(test) c(tests$p_value[tests$test %in% test], NA)[1]
  data.frame(size = p(c("size t", "size F")), shape = p(c("mean shape", "mean shape F")),
             t2 = p("T2"), pc1 = p("PC1"),
             components = least(tests$p_adjusted[grepl("^PC", tests$test)]),
             points = least(compared$points$p_adjusted), dispersion = p("dispersion"))
}

done <- if (file.exists(file)) read.csv(file, colClasses = c(sizes = "character"))

cell <- function(what, sizes, ratio, equal, p_of) {
  key <- data.frame(what = what, sizes = paste(sizes, collapse = ":"), ratio = ratio,
                    spread = if (equal) "pooled" else "separate")
  there <- if (!is.null(done)) merge(done, key)$seed
  for (seed in setdiff(seq_len(samples), there)) {
    new <- !file.exists(file)
    write.table(cbind(key, seed = seed, p_of(seed)), file, append = !new, sep = ",",
                row.names = FALSE, col.names = new, quote = FALSE)
  }
  message(what, " ", key$sizes, " ratio ", ratio, " ", key$spread, " done")
}

of_groups <- function(what, sizes, ratio, equal, effect = c(0, 0), form = "all") {
  cell(what, sizes, ratio, equal, function(seed) {
    p_values(draw_groups(sizes, ratio, seed, effect, form = form), seed, equal_spread = equal)
  })
}

# One variable, 24 and 6: t whose variances are raised to the pooled one, at most `most` times.
# Critical values are those at ratio 1, as regroupings have them.
raising <- function(most, sizes = c(24, 6), effect = 1.25, n = 1e5) {
  set.seed(1)
  score <- function(ratio, effect = 0) {
    df <- sizes - 1
    off <- rnorm(n) * sqrt(1 / sizes[1] + ratio^2 / sizes[2]) + effect
    own <- cbind(rchisq(n, df[1]) / df[1], ratio^2 * rchisq(n, df[2]) / df[2])
    pooled <- drop(own %*% df) / sum(df)
    own <- pmax(own, pmin(pooled, most * own))
    part <- own / rep(sizes, each = n)
    count <- rowSums(part)^2 / drop(part^2 %*% (1 / df))
    count * log1p(off^2 / rowSums(part) / count)
  }
  least <- quantile(score(1), 0.95)
  ratio <- c(1 / 3, 1 / 2, 2 / 3, 1.5, 2, 3)
  level <- vapply(ratio, function(r) mean(score(r) > least), 0)
  round(c(most = most, power = mean(score(1, effect) > least), setNames(level, signif(ratio, 2))),
        3)
}
if ("variants" %in% wanted) {
  cat("raising variances, 24:6, level by ratio\n")
  print(t(vapply(c(1, 1.2, 1.5, 2, 3, Inf), raising, numeric(8))))
}

# The greatest power at ratio 1 of a test of one variable whose answer does not depend on scale,
# with a level of 0.05 at ratio 1 and `least` to `most` at the others. Such a test is a critical
# value of Student's t by the ratio of the variances (these are what normal variables leave to
# decide by); power is at most that of the Lagrangian, whatever its multipliers.
bounded_power <- function(least, most, ratio = c(1 / 3, 1 / 2, 2, 3), sizes = c(24, 6),
                          effect = 1.25, n = 3e5, bins = 40, rounds = 4000) {
  set.seed(1)
  df <- sizes - 1
  drawn <- function(ratio, effect = 0) {
    off <- rnorm(n) * sqrt(1 / sizes[1] + ratio^2 / sizes[2]) + effect
    own <- cbind(rchisq(n, df[1]) / df[1], ratio^2 * rchisq(n, df[2]) / df[2])
    list(t = abs(off) / sqrt(drop(own %*% df) / sum(df) * sum(1 / sizes)),
         ratio = own[, 2] / own[, 1])
  }
  none <- lapply(c(1, ratio), drawn)
  effects <- drawn(1, effect)
  limits <- c(-Inf, quantile(c(none[[1]]$ratio, none[[2]]$ratio, effects$ratio),
                             seq_len(bins - 1) / bins), Inf)
  values <- c(seq(0.5, 6, 0.05), Inf)
  # Share of samples with t from each value up, by bin.
  above <- function(one) {
    at <- table(factor(findInterval(one$t, values), 0:length(values)), cut(one$ratio, limits))
    apply(at, 2, function(x) rev(cumsum(rev(x))))[-1, ] / n
  }
  size <- lapply(none, above)
  power <- above(effects)
  upper <- c(0.05, rep(most, length(ratio)))
  lower <- c(0.05, rep(least, length(ratio)))
  up <- c(2, rep(0.1, length(ratio)))
  low <- 0 * up
  best <- Inf
  for (round in seq_len(rounds)) {
    gain <- power - Reduce(`+`, Map(`*`, size, up - low))
    chosen <- cbind(apply(gain, 2, which.max), seq_len(bins))
    found <- vapply(size, function(x) sum(x[chosen]), 0)
    best <- min(best, sum(gain[chosen]) + sum(up * upper) - sum(low * lower))
    step <- 30 / (1 + round / 50)
    up <- pmax(up + step * (found - upper), 0)
    low <- pmax(low + step * (lower - found), 0)
  }
  c(least = least, most = most, power = round(best, 3),
    pooled = round(mean(effects$t > quantile(none[[1]]$t, 0.95)), 3))
}
if ("bound" %in% wanted) {
  cat("greatest power of any test, 24:6, and of the pooled one\n")
  print(rbind(bounded_power(0, 0.08), bounded_power(0.03, 0.08)))
}

two <- list(c(15, 15), c(24, 6), c(6, 24))
three <- list(c(10, 10, 10), c(18, 6, 6))
if ("level" %in% wanted) {
  for (ratio in c(3, 2, 1)) for (sizes in two) of_groups("level", sizes, ratio, FALSE)
  of_groups("level", c(24, 6), 1.5, FALSE)
  of_groups("level", c(24, 6), 3, TRUE)
}
if ("three" %in% wanted) {
  for (ratio in c(3, 2, 1)) for (sizes in three) of_groups("level", sizes, ratio, FALSE)
}
if ("chance" %in% wanted) of_groups("level", c(15, 15), 1, FALSE)
# The test of size by itself, on the sizes of draw_groups(), six times as many samples.
of_size <- function(sizes, ratio, equal, effect = 0, n = 6 * samples) {
  inner <- function(name) getFromNamespace(name, "crestline")
  code <- rep(seq_along(sizes), sizes)
  sd <- 0.04 * c(1, rep(ratio, length(sizes) - 1))[code]
  p <- vapply(seq_len(n), function(seed) {
    set.seed(seed)
    size <- cbind(sd * rnorm(length(code)) + effect * (code == 2))
    labels <- cbind(code, replicate(99, sample(code)), deparse.level = 0)
    inner("permutation_p")(inner("raised_scores")(size - mean(size), labels, equal))
  }, 0)
  data.frame(sizes = paste(sizes, collapse = ":"), ratio = ratio, effect = effect,
             spread = if (equal) "pooled" else "separate", share = round(mean(p <= 0.05), 3), n = n)
}
if ("size" %in% wanted) {
  level <- lapply(c(two, three), function(sizes) lapply(3:1, of_size, sizes = sizes, equal = FALSE))
  power <- lapply(two, function(sizes) lapply(c(FALSE, TRUE), of_size, sizes = sizes, ratio = 1,
                                              effect = 0.05))
  print(do.call(rbind, c(do.call(c, level), do.call(c, power))), row.names = FALSE)
}
if ("form" %in% wanted) {
  for (form in c("first", "noise")) for (sizes in two) {
    of_groups(paste("form", form), sizes, 3, FALSE, form = form)
  }
}
if ("power" %in% wanted) {
  for (sizes in two) for (equal in c(FALSE, TRUE)) {
    for (effect in list(c(0.005, 0.03), c(0.01, 0.05))) {
      of_groups(paste("power", effect[1]), sizes, 1, equal, effect)
    }
  }
}

# Persons differ by three times what a repeat of one differs by.
draw_blocks <- function(persons, repeats, seed, effect = 0) {
  data <- draw_groups(c(persons, 0), 1, seed, spread = 0.06)
  error <- draw_groups(c(persons * repeats, 0), 1, seed + 10000)
  mean <- apply(error$x, 1:2, mean)
  x <- data$x[, , rep(seq_len(persons), repeats)] + error$x - as.vector(mean)
  second <- seq_len(persons * repeats) > persons
  x[1:4, 3, second] <- x[1:4, 3, second] + effect
  list(x = x, person = rep(seq_len(persons), repeats), second = second)
}

if ("designs" %in% wanted) {
  pairs <- function(effect, blocked) function(seed) {
    drawn <- draw_blocks(12, 2, seed, effect)
    data <- list(x = drawn$x, group = factor(ifelse(drawn$second, "after", "before")))
    p_values(data, seed, block = if (blocked) drawn$person)
  }
  repeats <- function(blocked) function(seed) {
    drawn <- draw_blocks(20, 2, seed)
    data <- list(x = drawn$x, group = factor(c("a", "b")[drawn$person %% 2 + 1]))
    p_values(data, seed, block = if (blocked) drawn$person)
  }
  # Two sites with scanners of their own; patients mostly at the second.
  sites <- function(blocked) function(seed) {
    data <- draw_groups(c(15, 15), 1, seed, c(0.02, 0.05))
    site <- data$group
    data$group <- factor(rep(c("control", "patient", "control", "patient"), c(11, 4, 4, 11)))
    p_values(data, seed, block = if (blocked) site)
  }
  for (blocked in c(TRUE, FALSE)) {
    way <- if (blocked) "block" else "independent"
    cell(paste("pairs none", way), c(12, 12), 1, FALSE, pairs(0, blocked))
    cell(paste("pairs effect", way), c(12, 12), 1, FALSE, pairs(0.01, blocked))
    cell(paste("repeats", way), c(20, 20), 1, FALSE, repeats(blocked))
    cell(paste("sites", way), c(15, 15), 1, FALSE, sites(blocked))
  }
}

if (!file.exists(file)) quit()
found <- read.csv(file, colClasses = c(sizes = "character"))
key <- found[c("what", "sizes", "ratio", "spread")]
rate <- aggregate(found[6:12] <= 0.05, key, mean)
print(cbind(rate[1:4], round(rate[5:11], 3), n = aggregate(found$seed, key, length)$x),
      row.names = FALSE)

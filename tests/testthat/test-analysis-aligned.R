x <- posed_sample(n = 9, sd = 0.1)
dimnames(x) <- list(letters[1:12], c("x", "y", "z"), paste0("s", 1:9))

# As align() of the same specimens gives it, in the same pose (arrays: that of the first complete
# one).
expect_alike <- function(found, truth, posed = FALSE) {
  lay <- if (posed) identity else superimposition(found$mean, truth$mean, FALSE)
  expect_equal(lay(found$mean), truth$mean, tolerance = 1e-8, ignore_attr = TRUE)
  for (i in names(truth)) expect_equal(lay(found[[i]]), truth[[i]], tolerance = 1e-8,
                                       ignore_attr = TRUE)
  for (field in c("size", "weights", "scale", "tangent", "level", "places", "triangles")) {
    expect_equal(do.call(`$`, list(found, field)), do.call(`$`, list(truth, field)),
                 tolerance = 1e-8)
  }
  expect_equal(as.data.frame(found), as.data.frame(truth), tolerance = 1e-7)
}

test_that("an alignment is a container of its configurations", {
  aligned <- align(x)
  expect_length(aligned, 9)
  expect_identical(names(aligned), paste0("s", 1:9))
  expect_identical(aligned[["s4"]], aligned$coords[, , "s4"])
  expect_identical(aligned[[4]], aligned$coords[, , 4])
  seen <- 0
  for (one in aligned) seen <- seen + one
  expect_equal(seen / 9, apply(aligned$coords, 1:2, mean))
  expect_identical(lapply(aligned, dim)[[9]], c(12L, 3L))
  expect_identical(as.array(aligned), aligned$coords)
  expect_identical(names(as.list(aligned)), names(aligned))
  expect_crestline_error(aligned$size_of, "no field")
  expect_crestline_error(aligned[["s10"]], c("no specimen s10", "s1, "))
  expect_crestline_error(aligned[[10]], "no specimen 10")
  expect_crestline_error(aligned[, , 1], "no rows")
  expect_crestline_error(aligned[[1, 2]], "no rows")
  expect_crestline_error(aligned[c("s1", "s1", "s2")], "twice")
})

test_that("a part is the alignment of these specimens, in every scaling, with weights and without",
          {
  weights <- c(3, rep(1, 10), 0.5)
  for (scale in list(TRUE, "full", FALSE)) {
    for (tangent in c(TRUE, FALSE)) {
      for (weight in list(NULL, weights)) {
        aligned <- align(x, scale = scale, tangent = tangent, weights = weight)
        expect_alike(aligned[-3],
                     align(x[, , -3], scale = scale, tangent = tangent, weights = weight))
      }
    }
  }
  aligned <- align(x)
  expect_alike(aligned[c(2, 5, 9)][c("s9", "s2")], align(x[, , c(9, 2)]))
  expect_alike(aligned[stats::setNames(1:9 > 4, names(aligned))[9:1]], align(x[, , 5:9]))
})

test_that("sizes and the pose stay, and another order changes nothing", {
  aligned <- align(x)
  part <- aligned[4:9]
  expect_equal(part$size, aligned$size[4:9], tolerance = 1e-12)
  expect_lt(max(abs(part$mean - aligned$mean)), 0.1)
  expect_identical(aligned[9:1]$coords, aligned$coords[, , 9:1])
  expect_identical(aligned[9:1]$mean, aligned$mean)
  expect_identical(aligned[], aligned)
  expect_crestline_error(aligned[1], "no alignment")
})

test_that("a mean without the odd one is that of the others", {
  odd <- x
  odd[, , 9] <- odd[, , 9] * rep(c(1, 1, 3), each = 12)
  expect_warning(all <- align(odd), "s9", class = "crestline_far")
  expect_gt(max(abs(all$mean - align(x[, , -9])$mean)), 0.01)
  expect_no_warning(part <- all[-9])
  expect_alike(part, align(x[, , -9]))
})

test_that("missing points are estimated from those that are left, dropped ones stay away", {
  gap <- x
  gap[5, , 2] <- NA
  gap[8, , c(2, 7)] <- NA
  aligned <- align(gap)
  expect_alike(aligned[-3], align(gap[, , -3]))
  expect_identical(aligned[c(1, 7, 8)]$missing$id, "s7")
  expect_equal(nrow(aligned[c(1, 3, 8)]$missing), 0)
  expect_alike(aligned[c(1, 3, 8)], align(gap[, , c(1, 3, 8)]))
  dropped <- align(gap, missing = "drop")
  part <- dropped[-2]
  expect_equal(dim(part$coords), c(10, 3, 8))
  expect_identical(part$missing$id, "s7")
  expect_alike(dropped[c(1, 2, 7)], align(gap[-c(5, 8), , c(1, 2, 7)]) |> with_dropped(dropped))
})

test_that("of a sample it is what align() gives of a part of the sample, in the same pose", {
  sample <- homologise(paired_sample(), progress = FALSE)
  for (level in c("landmarks", "curves", "surface", "model")) {
    expect_alike(align(sample, level)[-2], align(sample[-2], level), posed = TRUE)
  }
  expect_alike(align(sample, "surface", weights = "area")[-2],
               align(sample[-2], "surface", weights = "area"), posed = TRUE)
  expect_alike(align(sample, "curves", weights = "places")[-2],
               align(sample[-2], "curves", weights = "places"), posed = TRUE)
})

test_that("alignments are joined by aligning all together", {
  aligned <- align(x)
  expect_alike(c(aligned[1:4], aligned[5:9]), aligned)
  expect_alike(c(align(x[, , 1:4]), align(x[, , 5:7]), align(x[, , 8:9])), aligned)
  expect_identical(c(aligned), aligned)
  expect_crestline_error(c(aligned, aligned[2:3]), "s2, s3")
  expect_crestline_error(c(aligned, align(x[1:11, , ])), "different points")
  expect_crestline_error(c(align(x[, , 1:4]), align(x[, , 5:9], scale = FALSE)), "settings")
  expect_crestline_error(c(align(x[, , 1:4]), align(x[, , 5:9], "other")), "level")
  expect_crestline_error(c(aligned, x), "aligned")
})

test_that("a foreign alignment keeps its co-ordinates", {
  foreign <- as_aligned(align(x)$coords, size = align(x)$size)
  part <- foreign[-1]
  expect_identical(part$coords, foreign$coords[, , -1])
  expect_equal(part$mean, apply(foreign$coords[, , -1], 1:2, mean), ignore_attr = TRUE)
  expect_identical(part$size, foreign$size[-1])
  expect_crestline_error(c(foreign[1:4], foreign[5:9]), "not known")
})

test_that("components and comparisons of a part are those of the part", {
  aligned <- align(x)
  expect_equal(shape_pca(aligned[-1])$sdev, shape_pca(align(x[, , -1]))$sdev, tolerance = 1e-8)
  sex <- stats::setNames(rep(c("F", "M"), length.out = 9), names(aligned))
  ours <- compare_groups(aligned[-1], sex, seed = 1, n_perm = 20, progress = FALSE,
                         settings = comparison_settings(components = 2))
  theirs <- compare_groups(x[, , -1], sex, seed = 1, n_perm = 20, progress = FALSE,
                           settings = comparison_settings(components = 2))
  expect_equal(ours$tests$p_value, theirs$tests$p_value)
})

test_that("names are changed everywhere; fields that do not fit together are refused", {
  gap <- x
  gap[8, , 7] <- NA
  aligned <- align(gap)
  names(aligned) <- letters[1:9]
  expect_identical(dimnames(aligned$coords)[[3]], letters[1:9])
  expect_identical(names(aligned$size), letters[1:9])
  expect_identical(aligned$missing$id, "g")
  expect_crestline_error(names(aligned) <- rep("a", 9), "names")
  broken <- align(x)
  broken$mean <- broken$mean[-1, ]
  expect_crestline_error(shape_pca(broken), "do not fit together")
  expect_crestline_error(broken$coords <- "none", "array of numbers")
  expect_crestline_error(broken$colour <- 1, "no field")
  expect_crestline_error(broken[["s1"]] <- 1, "cannot be replaced")
})

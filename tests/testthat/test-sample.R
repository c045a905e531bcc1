shapes <- paired_sample()
sample <- homologise(shapes, progress = FALSE)

arrays_of <- function(x) lapply(c("landmarks", "curves", "surface"),
                                function(level) as.array(x, level))

test_that("a sample is a container of its shapes", {
  ids <- paste0("ball", 1:4)
  expect_length(sample, 4)
  expect_identical(names(sample), ids)
  expect_identical(sample[["ball3"]], sample$shapes$ball3)
  expect_identical(sample[[2]], sample$shapes[[2]])
  seen <- character()
  for (shape in sample) seen <- c(seen, shape$id)
  expect_identical(seen, ids)
  expect_identical(unname(vapply(sample, function(shape) shape$id, "")), ids)
  expect_identical(lapply(sample, `[[`, "id"), as.list(stats::setNames(ids, ids)))
  expect_identical(unlist(Map(function(a, b) a$id == b, sample, ids), use.names = FALSE),
                   rep(TRUE, 4))
  expect_identical(as.list(sample), sample$shapes)
  expect_identical(class(as.list(sample)), "list")
  expect_identical(seq_along(sample), 1:4)
  expect_true(all(vapply(sample, inherits, NA, "shape")))
  expect_output(str(sample, max.level = 1, give.attr = FALSE), "ball1")
})

test_that("fields are given by `$`, and others refused", {
  expect_s3_class(sample$template, "shape")
  expect_s3_class(sample$convergence, "data.frame")
  expect_s3_class(sample$missing, "data.frame")
  expect_crestline_error(sample$ball1, c("no field `ball1`", "template"))
  expect_crestline_error(sample$shape, "no field")
})

test_that("specimens are dropped without sliding again, in every way of asking", {
  without <- sample[-3]
  expect_s3_class(without, "shape_sample")
  expect_identical(names(without), c("ball1", "ball2", "ball4"))
  expect_identical(without$template, sample$template)
  expect_identical(without$convergence, sample$convergence)
  for (id in names(without)) expect_identical(without[[id]], sample[[id]])
  expect_identical(arrays_of(without), lapply(arrays_of(sample), function(x) x[, , -3]))
  expect_identical(sample[c("ball1", "ball2", "ball4")], without)
  expect_identical(sample[c(TRUE, TRUE, FALSE, TRUE)], without)
  expect_identical(sample[c(1, 2, 4)], without)
  expect_identical(sample[factor(c("ball1", "ball2", "ball4"), c("ball4", "ball2", "ball1"))],
                   without)
  expect_identical(sample[c(ball4 = TRUE, ball3 = FALSE, ball2 = TRUE, ball1 = TRUE)], without)
  expect_identical(sample[c(4, 1)][["ball1"]], sample[["ball1"]])
  expect_identical(sample[], sample)
  expect_identical(sample[TRUE], sample)
  expect_identical(names(split(sample, c("a", "b", "a", "b"))$b), c("ball2", "ball4"))
  expect_identical(names(rev(sample)), rev(names(sample)))
  expect_identical(names(head(sample, 2)), c("ball1", "ball2"))
})

test_that("a part equals the sample that is made of these shapes against the same template", {
  from_three <- homologise(shapes[-3], sample$template, rounds = 0, progress = FALSE)
  expect_identical(arrays_of(sample[-3]), arrays_of(from_three))
  expect_identical(as.data.frame(sample[-3]), as.data.frame(from_three))
  expect_identical(sample[-3]$missing, from_three$missing)
})

test_that("what is missing is told of the specimens that are left", {
  gap <- sample$shapes
  gap$ball2$points$x[3:5] <- NA
  holed <- new_shape_sample(gap, sample$template, sample$convergence)
  expect_identical(unique(holed$missing$id), "ball2")
  expect_equal(nrow(holed[-2]$missing), 0)
  expect_identical(holed["ball2"]$missing, holed$missing)
  expect_output(print(holed[c("ball1", "ball2")]), "missing: 3 points of ball2")
})

test_that("no specimen at all is a sample of none", {
  none <- sample[c(FALSE, FALSE, FALSE, FALSE)]
  expect_length(none, 0)
  expect_equal(dim(as.array(none, "curves")), c(50, 3, 0))
  expect_equal(nrow(as.data.frame(none)), 0)
  expect_equal(nrow(none$missing), 0)
  expect_output(print(none), "0 specimens")
  expect_crestline_error(align(none, "curves"), "no specimen")
  expect_crestline_error(align(sample[1], "curves"), "one specimen only")
})

test_that("a specimen that is not there is refused with what is there", {
  expect_crestline_error(sample[["ball9"]], c("no specimen ball9", "ball1, ball2"))
  expect_crestline_error(sample[["Ball3"]], "There are 4: ball3")
  expect_crestline_error(sample[[5]], c("no specimen 5", "ball4"))
  expect_crestline_error(sample[[0]], "ball1")
  expect_crestline_error(sample[[-1]], "ball1")
  expect_crestline_error(sample[[c("ball1", "ball2")]], "one name")
  expect_crestline_error(sample[[TRUE]], "one name")
  expect_crestline_error(sample[["template"]], "no specimen template")
  expect_crestline_error(sample[c("ball1", "nobody", NA)], "nobody, NA")
  expect_crestline_error(sample[7], "no specimen 7")
  expect_crestline_error(sample[-7], "no specimen 7")
  expect_crestline_error(sample[c(-1, 2)], "chosen by")
  expect_crestline_error(sample[1.5], "chosen by")
  expect_crestline_error(sample[c(1, NA)], "chosen by")
  expect_crestline_error(sample[list("ball1")], "chosen by")
  expect_crestline_error(sample[c("ball1", "ball1")], "ball1 is asked for twice")
  expect_crestline_error(sample[c(TRUE, FALSE)], c("2 logical values", "4 specimens"))
  expect_crestline_error(sample[c(TRUE, NA, TRUE, TRUE)], "1 of them NA")
  expect_crestline_error(sample[c(a = TRUE, b = TRUE, c = TRUE, d = FALSE)],
                         "which are not the specimens")
  expect_crestline_error(sample[1, ], "no rows")
})

test_that("samples of one template are joined", {
  joined <- c(sample[c(1, 3)], sample[c("ball2", "ball4")])
  expect_identical(names(joined), c("ball1", "ball3", "ball2", "ball4"))
  expect_identical(joined[names(sample)], sample)
  new <- paired_shape(c(1.05, 1.05, 1.15), "new")
  more <- homologise(list(new), sample$template, rounds = 0, progress = FALSE)
  expect_identical(as.array(c(sample, more), "surface")[, , "new"],
                   coords(slide(new, sample$template), "surface"))
  expect_identical(c(more, sample)$convergence, sample$convergence)
  expect_identical(c(sample), sample)
  expect_identical(c(sample, NULL), sample)
})

test_that("samples of different templates or schemes, and ids twice, are not joined", {
  expect_crestline_error(c(sample, sample[2]), c("ball2", "more than one"))
  other <- homologise(shapes[3:4], progress = FALSE)
  error <- expect_crestline_error(c(sample[1:2], other), "different templates")
  expect_match(error$remedy, "rounds = 0, template")
  denser <- paired_scheme(function(tables) {
    tables$curves$n[7] <- 9
    tables
  })
  foreign <- homologise(list(paired_shape(id = "x", scheme = denser),
                             paired_shape(c(1, 1, 1.1), "y", denser)), progress = FALSE)
  error <- expect_crestline_error(c(sample, foreign), "different schemes, both named paired")
  expect_match(error$remedy, "rounds = 0, template")
  expect_crestline_error(c(sample, list(shapes[[1]])), "shape_sample")
})

test_that("specimens are renamed in the shapes too, and not replaced", {
  renamed <- sample
  names(renamed) <- letters[1:4]
  expect_identical(renamed[["c"]]$id, "c")
  expect_identical(names(renamed$shapes), letters[1:4])
  expect_identical(renamed[["c"]]$points, sample[["ball3"]]$points)
  expect_crestline_error(names(renamed) <- c("a", "a", "b", "c"), "names")
  expect_crestline_error(names(renamed) <- c("a", "b"), "4 specimens")
  changed <- sample
  expect_crestline_error(changed[["ball1"]] <- sample[["ball2"]], "cannot be replaced")
  expect_crestline_error(changed["ball1"] <- NULL, "cannot be replaced")
  expect_crestline_error(changed$extra <- 1, "cannot be set")
  expect_crestline_error(changed$template <- "mean", "template")
  expect_crestline_error(changed$shapes <- stats::setNames(sample$shapes, letters[1:4]),
                         "ids of its shapes")
})

test_that("analyses take a part of a sample as they take a whole one", {
  part <- sample[c(4, 2, 1)]
  same <- new_shape_sample(sample$shapes[c(4, 2, 1)], sample$template)
  for (level in c("landmarks", "curves", "surface", "model")) {
    expect_identical(as.array(align(part, level)), as.array(align(same, level)))
  }
  pca <- shape_pca(align(part, "curves"))
  expect_identical(rownames(pca$x), c("ball4", "ball2", "ball1"))
  frame <- as_geomorph(part, "curves", data = data.frame(id = names(sample), stretch = 1:4))
  expect_identical(frame$stretch, c(4L, 2L, 1L))
  sex <- c(ball1 = "F", ball2 = "F", ball3 = "M", ball4 = "M")
  compared <- compare_groups(sample[names(sex)[c(4, 3, 2, 1)]], sex, "curves", n_perm = 5,
                             progress = FALSE, settings = comparison_settings(components = 1))
  expect_identical(as.character(compared$group), c("M", "M", "F", "F"))
  repeats <- repeatability(part, c("a", "a", "b"), level = "curves")
  expect_equal(repeats$counts[["measurements"]], 3)
})

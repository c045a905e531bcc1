# An upright "face": half an egg that looks to +z with up +y, so that the subject's left is +x.
egg <- function() {
  ball <- ball_mesh(4)
  ball$vb[1:3, ] <- ball$vb[1:3, ] * c(70, 100, 60)
  ball$it <- ball$it[, ball$vb[3, ball$it[1, ]] > 0]
  ball
}
on_egg <- function(x, y) c(x, y, 60 * sqrt(1 - (x / 70)^2 - (y / 100)^2))
egg_landmarks <- function() {
  rbind(n = on_egg(0, 40), pn = on_egg(0, 0), gn = on_egg(0, -60), exL = on_egg(35, 30),
        exR = on_egg(-35, 30), chL = on_egg(20, -40), chR = on_egg(-20, -40))
}

test_that("a good set passes and is put on the surface, with the move told", {
  s <- expect_no_warning(specimen(egg(), egg_landmarks(), id = "egg"))
  expect_on_mesh(s$geometry$located, s$mesh)
  expect_equal(report_count(s, "landmarks beside the surface"), 6)  # pn is a vertex
  expect_match(s$report$action[s$report$check == "landmarks beside the surface"], "put on it")
  expect_lt(max(abs(s$landmarks - egg_landmarks())), 1)
})

test_that("a data frame serves as well, names in a column or as row names", {
  table <- data.frame(z = egg_landmarks()[, 3], Landmark = rownames(egg_landmarks()),
                      x = egg_landmarks()[, 1], y = egg_landmarks()[, 2])
  expect_equal(specimen(egg(), table)$landmarks, specimen(egg(), egg_landmarks())$landmarks)
  expect_equal(specimen(egg(), table[-2])$landmarks, specimen(egg(), egg_landmarks())$landmarks)
})

test_that("landmarks named twice, without names or of the wrong shape are refused by name", {
  x <- egg_landmarks()
  rownames(x)[2:3] <- "n"
  expect_crestline_error(specimen(egg(), x, id = "e1"),
                         c("e1", "named twice: n", "own name"), id = "e1")
  rownames(x)[2:3] <- c("", "a")
  expect_crestline_error(specimen(egg(), x, id = "e1"), c("e1", "row 2"))
  expect_crestline_error(specimen(egg(), unname(egg_landmarks())), "without a name")
  expect_crestline_error(specimen(egg(), data.frame(x = 1, y = 2, z = 3)), "without a name")
  expect_crestline_error(specimen(egg(), egg_landmarks()[, 1:2]), "7 x 2")
  expect_crestline_error(specimen(egg(), "chL"), "chL")
  expect_crestline_error(specimen(egg(), matrix("a", 1, 3)), "1 x 3 character")
})

test_that("NA, NaN and Inf are missing landmarks", {
  x <- egg_landmarks()
  x["gn", 2] <- NA
  x["pn", ] <- Inf
  expect_warning(s <- specimen(egg(), x), "taken as missing: gn (no y).", fixed = TRUE,
                 class = "crestline_partial_landmarks")
  expect_true(all(is.na(s$landmarks[c("gn", "pn"), ])))
  expect_match(s$report$action[s$report$check == "landmarks missing"], "pn, gn")
})

test_that("two landmarks at one place are told of", {
  x <- egg_landmarks()
  expect_no_warning(specimen(egg(), x))
  x["gn", ] <- x["pn", ]
  expect_warning(specimen(egg(), x), "landmarks at one place: pn and gn",
                 class = "crestline_same_place")
})

test_that("a landmark 5 mm off a face is refused by name, a nearer one put on it", {
  x <- egg_landmarks()
  x["pn", 3] <- x["pn", 3] + 5
  expect_crestline_error(specimen(egg(), x, id = "e2"),
                         c("e2", "off the surface", "pn (by 5", "tolerance"), id = "e2")
  # The error gives the value that would do, if the landmark is only a little off
  needed <- sub(".*`tolerance = ([0-9.]+)`.*", "\\1",
                rlang::catch_cnd(specimen(egg(), x), "error")$remedy)
  expect_warning(s <- specimen(egg(), x, tolerance = as.numeric(needed)), "pn [(]by 5[)]",
                 class = "crestline_far_landmarks")
  expect_equal(unname(s$landmarks["pn", 1:2]), c(0, 0), tolerance = 0.1)
  x["pn", 3] <- 61
  expect_lt(specimen(egg(), x)$landmarks["pn", 3], 60.01)
  # A tolerance is a share, and no length
  expect_crestline_error(specimen(egg(), x, tolerance = 5), c("`tolerance` is 5", "not a length"))
  x["pn", 3] <- 100
  far <- expect_crestline_error(specimen(egg(), x), "0.01 of its size")
  expect_no_match(far$remedy, "tolerance")
})

test_that("another unit or frame is named with the factor that would fit", {
  x <- egg_landmarks()
  expect_crestline_error(specimen(egg(), x / 10, id = "cm"),
                         c("cm", "multiplied by 10:"), id = "cm")
  expect_crestline_error(specimen(egg(), x / 1000), "multiplied by 1000:")
  expect_crestline_error(specimen(egg(), x * 10), "divided by 10:")
  expect_crestline_error(specimen(egg(), x / 25.4), "multiplied by 25.4:")
  shifted <- egg()
  shifted$vb[1:2, ] <- shifted$vb[1:2, ] + 300
  expect_crestline_error(specimen(shifted,
                                  (x + rep(c(300, 300, 0), each = 7)) *
                                  rep(c(-1, -1, 1), each = 7)), c("negated", "frame = \"RAS\""))
})

test_that("left for right is warned of, whatever the position of the head", {
  x <- egg_landmarks()
  swapped <- x
  rownames(swapped) <- c("n", "pn", "gn", "exR", "exL", "chR", "chL")
  expect_warning(s <- specimen(egg(), swapped, id = "mirror"), "specimen mirror.*mirrored",
                 class = "crestline_mirrored")
  expect_equal(report_count(s, "landmarks mirrored"), 1)
  turn <- qr.Q(qr(matrix(c(1, 2, 3, -1, 0.5, 2, 0, 1, -2), 3)))
  turn <- turn * sign(det(turn))
  turned <- egg()
  turned$vb[1:3, ] <- turn %*% turned$vb[1:3, ]
  expect_no_warning(specimen(turned, x %*% t(turn)))
  expect_warning(specimen(turned, swapped %*% t(turn)), class = "crestline_mirrored")
  reflected <- egg()
  reflected$vb[1, ] <- -reflected$vb[1, ]
  reflected$it <- reflected$it[c(1, 3, 2), ]
  expect_warning(specimen(reflected, x * rep(c(-1, 1, 1), each = 7)), class = "crestline_mirrored")
})

test_that("without pairs or midline nothing is said of left and right", {
  x <- egg_landmarks()
  expect_no_warning(specimen(egg(), x[1:3, ]))
  rownames(x) <- c("a", "b", "c", "exR", "exL", "chR", "chL")
  expect_no_warning(specimen(egg(), x))
  expect_warning(specimen(egg(), x, midline = c("a", "b", "c")), class = "crestline_mirrored")
})

test_that("the real faces are not mirrored", {
  for (name in c("scan_a", "template_male")) {
    s <- expect_no_warning(read_specimen(shared_data(name, "surface.ply"),
                                         shared_data(name, "landmarks.csv")))
    x <- s$landmarks
    side <- grepl("[LR]$", rownames(x))
    rownames(x)[side] <- chartr("LR", "RL", rownames(x)[side])
    expect_warning(specimen(s$mesh, x), class = "crestline_mirrored")
  }
})

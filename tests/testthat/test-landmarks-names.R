scheme <- face_scheme()
known <- scheme$landmarks$landmark
renamed <- function(...) {
  other <- c(...)
  ifelse(known %in% names(other), other[known], known)
}

test_that("names that the scheme does not know are listed with those that may be meant", {
  expect_null(unused_names(known, scheme))
  expect_equal(unused_names(renamed(pn = "prn", chL = "CHL"), scheme),
               "not used: prn, CHL; near: pn, chL", ignore_attr = TRUE)
  expect_equal(attr(unused_names(renamed(pn = "prn", chL = "CHL"), scheme), "near"),
               c(prn = "pn", CHL = "chL"))
  near <- function(...) unname(attr(unused_names(renamed(...), scheme), "near"))
  for (other in c("PN", "p n", "pronasale", "Pro-Nasale")) expect_equal(near(pn = other), "pn")
  for (other in c("ch left", "ch_L", "left ch", "Left_ch")) expect_equal(near(chL = other), "chL")
})

test_that("what is no more than another landmark is near nothing", {
  for (names in list(c(known, "prn"), renamed(chR = "chX"), renamed(chR = "xx"), renamed(gn = "me"),
                     setdiff(known, "tL"))) {
    expect_length(attr(unused_names(names, scheme), "near"), 0)
  }
  expect_equal(unused_names(c(known, "zyL"), scheme), "not used: zyL", ignore_attr = TRUE)
  # The other side of a pair is never near
  expect_length(attr(unused_names(c(setdiff(known, "acL"), "acR2"), scheme), "near"), 0)
})

test_that("fit_shape() warns where another landmark may be meant, and print() lists the unused", {
  corners <- rbind(c(-1, -1, 2), c(1, -1, 2), c(0, 1.5, 2), c(0, 0, 2))
  corners <- corners / sqrt(rowSums(corners^2))
  three <- curve_scheme(data.frame(landmark = c("a", "b", "C C")),
                        data.frame(curve = "ab", from = "a", to = "b", kind = "plane", n = 5),
                        name = "three")
  ball <- function(...) {
    specimen(Rvcg::vcgSphere(3), `rownames<-`(corners, c(...)), id = "ball", tolerance = 0.02)
  }
  expect_warning(shape <- fit_shape(ball("a", "b", "cc", "x"), three, progress = FALSE),
                 "not used: cc, x; near: C C", class = "crestline_unused_landmarks")
  expect_output(print(shape), "landmarks not used: cc, x; near: C C", fixed = TRUE)
  expect_match(shape$status$reason[shape$status$part == "C C"], "near: cc")
  expect_no_warning(shape <- fit_shape(ball("a", "b", "C C", "x"), three, progress = FALSE))
  expect_output(print(shape), "landmarks not used: x", fixed = TRUE)
  expect_crestline_error(fit_shape(ball("A", "B", "c c", "x"), three, progress = FALSE),
                         c("none of the landmarks", "near: a, b, C C"))
})

test_that("landmarks are renamed on reading, and never onto another's name", {
  file <- tempfile(fileext = ".ply")
  write_mesh(ball_mesh(), file)
  at <- rbind(prn = c(1, 0, 0), top = c(0, 0, 1))
  one <- read_specimen(file, at, names = c(prn = "pn"))
  expect_identical(rownames(one$landmarks), c("pn", "top"))
  expect_identical(unname(one$landmarks["pn", ]),
                   unname(read_specimen(file, at)$landmarks["prn", ]))
  expect_crestline_error(read_specimen(file, at, names = c(prn = "top")),
                         "two landmarks the name top")
  expect_warning(some <- read_specimen(file, at, names = c(prn = "pn", other = "x")),
                 "`names` has other", class = "crestline_warning")
  expect_identical(rownames(some$landmarks), c("pn", "top"))
  expect_crestline_error(read_specimen(file, at, names = c(other = "x")), "`names` has other")
  expect_crestline_error(read_specimen(file, at, names = "pn"), "`names`")
  expect_crestline_error(read_specimen(file, at, names = c(a = "x", b = "x")), "`names`")
})

# The landmarks of humface, with the names of some exchanged.
with_exchanged <- function(at, ...) {
  for (two in list(...)) rownames(at)[match(two, rownames(at))] <- rev(two)
  at
}

face_front <- function(at) unit_vector(at["pn", ] - colMeans(at[c("exL", "exR", "chL", "chR"), ]))
face_midline <- c("n", "se", "pn", "sn", "ls", "st", "li", "sl", "gn")

# What looks exchanged by names alone, and by the scheme of the face.
by_name <- function(at, front = face_front(at)) {
  exchanged_landmarks(at, front, side_pairs(rownames(at)), face_midline)
}
by_scheme <- function(at, front = face_front(at)) {
  exchanged_landmarks(at, front, side_pairs(rownames(at)), face_midline,
                      typical_landmarks(face_scheme()))
}

test_that("nothing is said of landmarks that are where they belong", {
  at <- humface_landmarks()
  right <- list(mirrored = FALSE, groups = list(), either = list())
  expect_identical(by_name(at), right)
  expect_identical(by_scheme(at), right)
  expect_identical(by_name(at[c("pn", "exL", "exR"), ], c(0, 0, 1)), right)
  at[c("gn", "tL"), ] <- NA
  expect_identical(by_scheme(at), right)
})

test_that("every pair by itself, and every set of pairs, is named", {
  at <- humface_landmarks()
  pairs <- side_pairs(rownames(at))
  each <- Map(c, pairs$left, pairs$right)
  for (set in c(as.list(seq_along(each)), list(1:2, 3:6, 1:6))) {
    wrong <- do.call(with_exchanged, c(list(at), each[set]))
    for (found in list(by_name(wrong, face_front(at)), by_scheme(wrong, face_front(at)))) {
      expect_setequal(unlist(found$groups), unlist(each[set]))
      expect_false(found$mirrored)
    }
  }
  mirrored <- do.call(with_exchanged, c(list(at), each))
  expect_true(by_name(mirrored, face_front(at))$mirrored)
  expect_true(by_scheme(mirrored, NULL)$mirrored)
  expect_length(by_scheme(mirrored, NULL)$groups, 0)
})

test_that("without up and front the fewer of the pairs are named; of equal numbers none", {
  at <- humface_landmarks()
  at <- at[grepl("[LR]$", rownames(at)), ]
  expect_setequal(unlist(by_name(with_exchanged(at, c("acL", "acR")), NULL)$groups),
                  c("acL", "acR"))
  four <- at[c("exL", "exR", "chL", "chR"), ]
  expect_length(by_name(with_exchanged(four, c("exL", "exR")), NULL)$groups, 0)
})

test_that("two of the mid-line are named, neighbours or not", {
  at <- humface_landmarks()
  for (two in list(c("pn", "sn"), c("li", "sl"), c("n", "se"), c("ls", "st"), c("n", "gn"),
                   c("pn", "li"))) {
    wrong <- with_exchanged(at, two)
    expect_setequal(unlist(by_name(wrong, face_front(at))$groups), two)
    expect_setequal(unlist(by_scheme(wrong, face_front(at))$groups), two)
  }
})

test_that("two of one side are named: symmetry leaves open on which, the scheme does not", {
  at <- humface_landmarks()
  for (two in list(c("exL", "enL"), c("chR", "cphR"), c("acL", "chL"))) {
    wrong <- with_exchanged(at, two)
    expect_true(all(two %in% unlist(by_name(wrong, face_front(at))$either)))
    expect_length(by_name(wrong, face_front(at))$groups, 0)
    expect_setequal(unlist(by_scheme(wrong, face_front(at))$groups), two)
  }
  expect_setequal(unlist(by_name(with_exchanged(at, c("sn", "acL")), face_front(at))$groups),
                  c("sn", "acL"))
})

test_that("by the scheme each of many exchanges is named, and a round of three", {
  at <- humface_landmarks()
  both <- utils::combn(rownames(at), 2)
  for (i in seq(1, ncol(both), by = 12)) {
    expect_setequal(unlist(by_scheme(with_exchanged(at, both[, i]), face_front(at))$groups),
                    both[, i])
  }
  round <- with_exchanged(at, c("exL", "acL"), c("acL", "gn"))
  expect_setequal(unlist(by_scheme(round, face_front(at))$groups), c("exL", "acL", "gn"))
  expect_length(by_scheme(round, face_front(at))$groups, 1)
})

test_that("neither pose nor unit changes what is said", {
  at <- with_exchanged(humface_landmarks(), c("acL", "acR"), c("pn", "sn"))
  front <- face_front(humface_landmarks())
  turn <- some_rotation(4)
  moved <- (at %*% t(turn) + rep(c(300, -20, 7), each = nrow(at))) / 1000
  expect_identical(by_name(moved, drop(turn %*% front)), by_name(at, front))
  expect_identical(by_scheme(moved, drop(turn %*% front)), by_scheme(at, front))
})

test_that("the door warns by name, prints it, and says it once", {
  at <- with_exchanged(humface_landmarks(), c("acL", "acR"))
  expect_warning(face <- specimen(humface_scan(), at, id = "slip"), "specimen slip.*acL and acR",
                 class = "crestline_exchanged")
  expect_output(print(face), "landmarks look exchanged: acL and acR", fixed = TRUE)
  quiet <- expect_no_warning(scheme_slips(face, face_scheme()), class = "crestline_exchanged")
  expect_identical(quiet$said[["acL"]], "acL and acR look exchanged")
  expect_true(all(is.na(quiet$said[c("exL", "pn")])))
})

test_that("the skull's landmarks are left alone", {
  at <- read_landmarks(system.file("extdata", "skull_landmarks.csv", package = "crestline"))
  found <- exchanged_landmarks(at, NULL, side_pairs(rownames(at)), face_midline)
  expect_identical(found, list(mirrored = FALSE, groups = list(), either = list()))
  wrong <- exchanged_landmarks(with_exchanged(at, c("alL", "alR")), NULL, side_pairs(rownames(at)),
                               face_midline)
  expect_setequal(unlist(wrong$groups), c("alL", "alR"))
})



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

test_that("doubtful landmarks are refused by the specimen's name, with a picture", {
  face <- find_landmarks(humface_scan(), id = "humface")
  expect_identical(check_placing(face), face)
  picture <- tempfile(fileext = ".png")
  face$placing$confidence[face$placing$landmark %in% c("pn", "exL")] <- 0.2
  expect_crestline_error(check_placing(face, picture = picture),
                         c("2 of 19", "pn (0.2)", "exL (0.2)", picture), id = "humface")
  expect_gt(file.size(picture), 1e4)
  unlink(picture)
  expect_s3_class(check_placing(face, doubtful = 0.2), "specimen")
  expect_s3_class(check_placing(face, least = 0.1), "specimen")
  face$placing$state <- "absent"
  expect_crestline_error(check_placing(face), "none of its landmarks")
  expect_crestline_error(check_placing(specimen(ball_mesh())), "not found but given")
})

test_that("meshes without landmarks go through a batch; those that fail say so", {
  skip_if_not_installed("future.apply")
  skip_if_not_installed("progressr")
  scheme <- face_scheme()
  curve <- scheme$curves[scheme$curves$curve == "mid-line lip left", ]
  lip <- curve_scheme(scheme$landmarks, curve, name = "lip")
  folder <- tempfile("scans")
  dir.create(folder)
  face <- specimen(humface_scan())
  write_mesh(face, file.path(folder, "face.ply"))
  ball <- ball_mesh(5)
  ball$vb[1:3, ] <- 100 * ball$vb[1:3, ]
  write_mesh(specimen(ball), file.path(folder, "ball.ply"))
  shapes <- fit_shapes(list.files(folder, "ply$", full.names = TRUE), lip, progress = FALSE)
  expect_equal(failures(shapes)$id, "ball")
  expect_match(failures(shapes)$message, "nothing on it is like the template")
  expect_true(shapes$face$status$ok[shapes$face$status$level == "curves"])
  placed <- humface_landmarks()
  at <- shapes$face$points[shapes$face$points$part == "chL", c("x", "y", "z")]
  expect_lt(sqrt(sum((unlist(at) - placed["chL", ])^2)), 3)
  unlink(folder, recursive = TRUE)
})

test_that("in a batch a doubtful landmark costs what hangs on it, most of them the specimen", {
  finder <- function(doubtful = 0) list(doubtful = doubtful, picture = tempfile(fileext = ".png"))
  given <- found_lines()
  doubted <- function(names) {
    placing <- given$placing
    placing$confidence[placing$landmark %in% names] <- 0.3
    with_placing(given, placing, given$match)
  }
  one <- without_doubted(doubted(c("pn", "chL")), finder())
  expect_true(all(is.na(one$landmarks[c("pn", "chL"), ])))
  expect_false(anyNA(one$landmarks[c("chR", "n"), ]))
  expect_false(anyNA(without_doubted(doubted("pn"), finder(0.2))$landmarks["pn", ]))
  used <- finder()
  expect_crestline_error(without_doubted(doubted(given$placing$landmark[1:13]), used),
                         c("13 of 19", used$picture))
  unlink(used$picture)
})

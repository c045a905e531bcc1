test_that("a surface without fault has none, a point moved past neighbours flips triangles", {
  shape <- quad_shape()
  face <- quad_specimen()
  expect_equal(nrow(surface_faults(shape, face)), 0)
  at <- which(shape$points$level == "surface")
  columns <- c("x", "y", "z", "face", "w1", "w2", "w3")
  rows <- at[match(c("3 3", "6 3"), shape$points$point[at])]
  shape$points[rows[1], columns] <- shape$points[rows[2], columns]
  faults <- surface_faults(shape, face)
  expect_true("flipped" %in% faults$fault)
  expect_true(all(faults$group == "quad"))
})

test_that("triangles that pass through one another are found, those that touch are not", {
  flat <- rbind(c(0, 0, 0), c(4, 0, 0), c(0, 4, 0))
  through <- rbind(c(1, 1, -1), c(1, 1, 1), c(5, 5, 1))
  beside <- through + 10
  above <- rbind(c(0, 0, 0), c(1, 1, 1), c(1, 2, 1))
  xyz <- rbind(flat, through, beside, above)
  expect_equal(unname(crossing_pairs(xyz, matrix(1:12, 3))), rbind(c(1, 2)))
  fan <- rbind(c(0, 0, 0), c(2, 0, -1), c(2, 1, 1))
  joined <- rbind(flat, fan[2:3, ])
  expect_equal(unname(crossing_pairs(joined, cbind(1:3, c(1, 4, 5)))), rbind(c(1, 2)))
  expect_equal(nrow(crossing_pairs(joined, cbind(1:3, c(1, 2, 5)))), 0)
})

test_that("a triangle that is there twice is doubled", {
  shape <- quad_shape()
  shape$scheme <- tampered(shape$scheme, function(x) {
    within_list(x, triangles = rbind(x$triangles, x$triangles[5, ]))
  })
  faults <- surface_faults(shape, quad_specimen())
  expect_equal(faults$fault, "doubled")
  expect_equal(unlist(faults[c("v1", "v2", "v3")]),
               unlist(shape$scheme$triangles[5, c("v1", "v2", "v3")]))
})

test_that("faults of the model are in the status of the patch, beside what was there", {
  shape <- quad_shape()
  shape$scheme <- tampered(shape$scheme, function(x) {
    within_list(x, triangles = rbind(x$triangles, x$triangles[5:6, ]))
  })
  noted <- note_faults(shape, surface_faults(shape, quad_specimen()))
  expect_equal(status_of(noted, "quad")$reason, "2 doubled triangles")
  shape$status$reason[shape$status$part == "quad"] <- "before"
  expect_equal(status_of(note_faults(shape, surface_faults(shape, quad_specimen())), "quad")$reason,
               "before; 2 doubled triangles")
  expect_true(status_of(noted, "quad")$ok)
})

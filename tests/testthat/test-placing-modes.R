prepared_face <- function() prepared_template(face_template(), find_settings(), 1)

test_that("the jaw turns about the hinge, what is above the mouth stays", {
  template <- prepared_face()
  opened <- jaw_opened(template, 0.3)
  at <- template$landmarks
  to <- opened$landmarks
  still <- c("pn", "n", "exL", "enR", "acL", "ls", "sn")
  expect_equal(to[still, ], at[still, ])
  hinge <- template$modes$hinge
  from <- at["gn", 2:3] - hinge
  turn <- rbind(c(cos(0.3), -sin(0.3)), c(sin(0.3), cos(0.3)))
  expect_equal(unname(to["gn", 2:3] - hinge), drop(turn %*% from))
  # Down, and half as far at the corners.
  expect_lt(to["gn", 2], at["gn", 2] - 10)
  half <- at["chL", 2:3] - hinge
  turn <- rbind(c(cos(0.15), -sin(0.15)), c(sin(0.15), cos(0.15)))
  expect_equal(unname(to["chL", 2:3] - hinge), drop(turn %*% half))
  expect_equal(colSums(opened$normal^2), rep(1, ncol(opened$normal)))
  expect_equal(jaw_opened(template, 0)$xyz, template$xyz)
})

test_that("the share of the jaw is 1 at the chin, 0 at the brow, and jumps between the lips", {
  template <- prepared_face()
  at <- template$landmarks
  share <- jaw_share(at, template$modes)
  names(share) <- rownames(at)
  expect_gt(min(share[c("li", "sl", "gn")]), 0.95)
  expect_lt(max(share[c("pn", "n", "exL", "exR", "sn", "ls")]), 0.05)
  expect_equal(share[["chL"]], share[["chR"]], tolerance = 0.01)
})

test_that("a smile moves the corners outwards, up and back, alike on both sides", {
  template <- prepared_face()
  way <- smiled(template, 0.4)$landmarks - template$landmarks
  expect_equal(unname(way["chL", ] * c(-1, 1, 1)), unname(way["chR", ]), tolerance = 0.01)
  expect_equal(sqrt(sum(way["chL", ]^2)), 0.4 * template$modes$corner[1], tolerance = 1e-3)
  expect_true(all(way["chL", 1:2] > 0) && way["chL", 3] < 0)
  expect_lt(max(abs(way[c("n", "exL", "exR", "gn"), ])), 0.2)
})

test_that("normals of a smile are those of the moved surface", {
  # On the plane z = 0 about the corner: moved tangents stay square to moved normals.
  modes <- list(corner = c(20, 0, 0), slit = "a")
  h <- 1e-5
  place <- c(24, 3, 0)
  one <- function(xyz, normal) {
    smiled(list(xyz = cbind(xyz), normal = cbind(normal), modes = modes,
                landmarks = matrix(0, 1, 3)), 0.3)
  }
  for (side in c(1, -1)) {
    at <- place * c(side, 1, 1)
    normal <- one(at, c(0, 0, 1))$normal[, 1]
    for (axis in list(c(h, 0, 0), c(0, h, 0))) {
      tangent <- (one(at + axis, c(0, 0, 1))$xyz - one(at - axis, c(0, 0, 1))$xyz)[, 1] / (2 * h)
      expect_lt(abs(sum(tangent * normal)), 1e-8)
    }
    expect_equal(sum(normal^2), 1)
  }
})

test_that("a template that moves with a slit opens to a scan whose jaw is open", {
  settings <- quick_settings()
  template <- prepared_template(face_template(), settings, 1)
  open <- jaw_opened(template, 0.3)
  cloud <- template[c("xyz", "normal", "k1", "k2", "border", "coarse", "spacing")]
  cloud[c("xyz", "normal")] <- open[c("xyz", "normal")]
  laid <- agreed_pose(template, c(no_pose(), list(cloud = cloud)), template$settings)
  laid[c("score", "misfit")] <- fitted_poses(
    template, cloud, cbind(laid$pose), c(5, 5), c(1, 1), template$settings
  )[[1]][c("score", "misfit")]
  found <- best_jaw(template, laid, template$settings)
  expect_true(found$open)
  expect_equal(found$template$landmarks, open$landmarks)
  whole <- expressed_pose(template, laid, template$settings)
  expect_gt(whole$laid$agree, 0.9)
  none <- template
  none$modes <- NULL
  expect_equal(expressed_pose(none, laid, none$settings)$template, none)
})

test_that("names that are no landmarks are refused", {
  placed <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  expect_crestline_error(landmark_template(placed, ear_names, slit = c("chL", "mouth")), "slit")
  expect_crestline_error(landmark_template(placed, ear_names, hinge = "jaw", slit = "chL"), "hinge")
})

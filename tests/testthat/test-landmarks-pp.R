pp_file <- function(...) landmark_file("pp", ...)
pp_point <- function(x, name, active = 1) {
  sprintf('  <point x="%s" y="2" z="3" active="%d" name="%s"/>', x, active, name)
}

test_that("what is written is read back, to the last bit", {
  expect_round_trip(hard_landmarks(), "pp")
  expect_round_trip(xyz(1, 2, 3, name = "<a & 'b'> &lt;"), "PP")
})

test_that("MeshLab's points are read, attributes in any order, inactive ones as missing", {
  x <- read_landmarks(pp_file(
    "<!DOCTYPE PickedPoints>", "<PickedPoints>",
    ' <DocumentData><DataFileName name="face.ply"/></DocumentData>',
    "<!-- ", pp_point(9, "no point"), "-->", pp_point("-2.25e-05", "pro &quot;nasale&quot;"),
    "<point name='n&#233;z'", " z='3' y='2'", " x='1' active='1' />", pp_point(0, "gn", 0),
    pp_point(4, ""), "</PickedPoints>"
  ))
  expect_equal(x, xyz(-2.25e-05, 2, 3, 1, 2, 3, NA, NA, NA, 4, 2, 3,
                      name = c("pro \"nasale\"", "n\u00e9z", "gn", "4")))
  expect_equal(nrow(read_landmarks(pp_file("<PickedPoints/>"))), 0)
})

test_that("what cannot be read is refused with file and remedy", {
  expect_refused(pp_file("<points/>"), "no PickedPoints")
  expect_refused(pp_file("<PickedPoints>", pp_point(1, "a")), "the end of PickedPoints is missing")
  expect_refused(pp_file("<PickedPoints>", '<point x="1" y="2" name="a"/>', "</PickedPoints>"),
                 "point 1 has no z")
  expect_refused(pp_file("<PickedPoints>", pp_point("1,5", "a"), "</PickedPoints>"),
                 "\"1,5\" is not a number")
  expect_refused(pp_file("<PickedPoints>", '<point x="1 y="2" z="3"/>', "</PickedPoints>"),
                 "a point cannot be read")
})

test_that("an entity of no sign stands for one that cannot be shown", {
  file <- landmark_file("pp", "<PickedPoints>", '<point x="1" y="2" z="3" name="a&#x110000;"/>',
                        "</PickedPoints>")
  expect_identical(rownames(read_landmarks(file)), "a\ufffd")
})

# A template from a random share, every specimen slid by itself.

test_that("a share's template is that of the share alone, and each is slid against it", {
  skip_without_futures()
  out <- tempfile("out-")
  on.exit(unlink(out, recursive = TRUE))
  shapes <- fit_shapes(batch_specimens(6), quad_scheme(), out)
  quiet <- function(...) suppressWarnings(homologise(..., progress = FALSE))
  sample <- quiet(shapes, template_from = 3, seed = 5)
  expect_identical(names(sample), names(shapes))
  chosen <- with_seed(5, sort(sample(6, 3)))
  share <- quiet(shapes[chosen])
  expect_equal(sample$template$points, share$template$points)
  alone <- quiet(shapes, template = share$template, rounds = 0)
  for (level in c("landmarks", "curves", "surface")) {
    expect_identical(as.array(sample, level), as.array(alone, level))
  }
  expect_identical(as.array(quiet(as.list(shapes), template_from = 3, seed = 5), "surface"),
                   as.array(sample, "surface"))
  expect_identical(sample$provenance$settings$homologise$template_from, 3L)
})

test_that("slid shapes go into files, and a run that was cut short goes on", {
  skip_without_futures()
  skip_if_not_installed("nanoparquet")
  out <- tempfile("out-")
  slid <- tempfile("slid-")
  on.exit(unlink(c(out, slid), recursive = TRUE))
  shapes <- fit_shapes(batch_specimens(4), quad_scheme(), out)
  run <- function(dir = slid) suppressWarnings(homologise(shapes, template_from = 3, seed = 1,
                                                          dir = dir, progress = FALSE))
  sample <- run()
  expect_s3_class(sample, "sample_files")
  expect_identical(names(sample), names(shapes))
  memory <- suppressWarnings(homologise(shapes, template_from = 3, seed = 1, progress = FALSE))
  points <- read_block(sample, 1)
  expect_identical(unname(points[sample$points$level == "surface", , ]),
                   unname(as.array(memory, "surface")))
  expect_crestline_error(run(), "has a sample already")
  # In more blocks, the last of them smaller
  more <- tempfile("more-")
  dir.create(more)
  on.exit(unlink(more, recursive = TRUE), add = TRUE)
  kept <- plain_list(read_batch(slid))
  base <- list(template = memory$template, provenance = memory$provenance)
  blocks <- write_cohort(kept, base, more, block = 3, least = 1)
  expect_identical(n_blocks(blocks), 4L)
  blocks <- write_cohort(kept, base, more, block = 3, least = 3)
  expect_identical(n_blocks(blocks), 2L)
  together <- array(c(read_block(blocks, 1), read_block(blocks, 2)), dim(points), dimnames(points))
  expect_identical(together, points)
  unlink(file.path(slid, c("sample.head", "block-0001.parquet", "ball 2.shape")))
  before <- file.mtime(file.path(slid, "ball 1.shape"))
  expect_identical(read_block(run(), 1), points)
  expect_identical(file.mtime(file.path(slid, "ball 1.shape")), before)
})

test_that("what was said of a slid shape is said again by a run that goes on", {
  shape <- fit_shape(batch_specimens(1)[[1]], edge_scheme(), progress = FALSE)
  dir <- tempfile("slid-")
  dir.create(dir)
  on.exit(unlink(dir, recursive = TRUE))
  task <- list(key = "some", name = "ball 1", file = file.path(dir, "ball 1.shape"))
  red <- data.frame(specimen = "ball 1", part = "ab", level = "curves")
  for (said in list(list(red = red, cut = 1.5), list(red = NULL, cut = NA_real_),
                    list(red = red[0, ], cut = 2))) {
    keep_slid(shape, task, said)
    again <- said_when_slid(open_kept(task$file)$about)
    expect_equal(again, list(red = if (NROW(said$red)) said$red, cut = said$cut))
  }
})

test_that("a slid shape is found again only if it was measured and slid in the same way", {
  shapes <- lapply(batch_specimens(2), fit_shape, quad_scheme(), progress = FALSE)
  names(shapes) <- c("ball 1", "ball 2")
  template <- template_shape(shapes[[1]], places_of(shapes[[1]]), "mean")
  keys <- function(shapes, ...) {
    given <- utils::modifyList(list(settings = slide_settings(), red = "warn",
                                    limits = quality_limits()), list(...))
    vapply(slide_tasks(shapes, template, given, NULL), `[[`, "", "key")
  }
  before <- keys(shapes)
  moved <- shapes
  moved[[2]]$points$x[1] <- moved[[2]]$points$x[1] + 1e-6
  expect_identical(keys(moved) == before, c("ball 1" = TRUE, "ball 2" = FALSE))
  other <- quality_limits(se_max = c(1, 7))
  expect_identical(keys(shapes, limits = other), before)
  expect_false(any(keys(shapes, red = "leave out", limits = other) ==
                     keys(shapes, red = "leave out")))
})

test_that("workers slide as one process does, and what fails is named", {
  skip_without_futures()
  skip_on_cran()
  out <- tempfile("out-")
  dir <- batch_folder(batch_specimens(4))
  on.exit({
    future::plan("sequential")
    unlink(c(out, dir), recursive = TRUE)
  })
  shapes <- fit_shapes(dir, quad_scheme(), out)
  quiet <- function(...) suppressWarnings(homologise(shapes, ..., progress = FALSE))
  one <- quiet()
  share <- quiet(template_from = 3, seed = 1)
  future::plan("multisession", workers = 2)
  expect_identical(as.array(quiet(), "surface"), as.array(one, "surface"))
  expect_identical(as.array(quiet(template_from = 3, seed = 1), "surface"),
                   as.array(share, "surface"))
  future::plan("sequential")
  gone <- setdiff(names(shapes), names(shapes)[with_seed(1, sort(sample(4, 3)))])
  unlink(file.path(dir, paste0(gone, ".ply")))
  last_scan$what <- NULL
  expect_warning(rest <- homologise(shapes, template_from = 3, seed = 1, red = "keep",
                                    progress = FALSE),
                 paste0("1 specimen could not be slid.*", gone), class = "crestline_not_slid")
  expect_setequal(names(rest), setdiff(names(shapes), gone))
  expect_crestline_error(homologise(shapes, seed = 1), "`template_from`")
})

# Tasks that cost their worker, and others that it held.

numbered_tasks <- function(n) {
  lapply(seq_len(n), function(i) list(name = as.character(i), value = i))
}

test_that("tasks give what they give, however many go together", {
  skip_without_futures()
  for (chunk in c(1, 2, 7)) {
    for (alone in c(FALSE, TRUE)) {
      expect_identical(run_tasks(numbered_tasks(5), function(task, by) task$value * by,
                                 list(by = 2), chunk, alone),
                       as.list(2 * 1:5))
    }
  }
  expect_error(run_tasks(numbered_tasks(2), function(task) stop("odd"), list(), 1), "odd")
  expect_identical(run_tasks(numbered_tasks(2), function(task) NULL, list(), 1), list(NULL, NULL))
})

test_that("a worker that dies costs its tasks, and those that end it again are told", {
  skip_without_futures()
  skip_on_cran() # two more processes
  skip_on_os("windows")
  before <- future::plan("multisession", workers = 2)
  on.exit(future::plan(before))
  deadly <- function(task, flag) {
    if (task$value == 3) tools::pskill(Sys.getpid(), 9)
    # Only the first time.
    if (task$value == 5 && !file.exists(flag)) {
      file.create(flag)
      tools::pskill(Sys.getpid(), 9)
    }
    task$value
  }
  flag <- tempfile("flag-")
  values <- run_tasks(numbered_tasks(8), deadly, list(flag = flag), 1)
  lost <- vapply(values, inherits, NA, "lost_task")
  expect_identical(which(lost), c(3L, 5L))
  expect_identical(values[!lost], as.list(c(1:2, 4L, 6:8)))
  again <- run_tasks(numbered_tasks(8)[lost], deadly, list(flag = flag), 1, alone = TRUE)
  expect_s3_class(again[[1]], "lost_task")
  expect_identical(again[[2]], 5L)
})

test_that("without a user, progress is a line now and then", {
  skip_without_futures()
  work <- function() {
    tick <- progressr::progressor(steps = 3)
    for (i in 1:3) tick("one")
    "done"
  }
  said <- capture.output(expect_identical(with_told_progress(work(), TRUE, 2, every = 0), "done"),
                         type = "message")
  expect_match(said, "3 of 3 done (2 read)", fixed = TRUE, all = FALSE)
  quiet <- capture.output(with_told_progress(work(), TRUE), type = "message")
  expect_length(quiet, 0)
  expect_length(capture.output(with_told_progress(work(), FALSE, every = 0), type = "message"), 0)
})

# A request as the server of a review sees it.
request <- function(origin, host = "127.0.0.1:4000", ...) {
  list2env(list(HTTP_ORIGIN = origin, HTTP_HOST = host, ...))
}

test_that("only a page of the same site may open the socket", {
  expect_true(is_own_site(request("http://127.0.0.1:4000")))
  expect_false(is_own_site(request("http://127.0.0.1:4001")))
  expect_false(is_own_site(request("http://evil.example")))
  expect_false(is_own_site(request("http://127.0.0.1:4000.evil.example")))
  expect_false(is_own_site(request("http://evil.example/127.0.0.1:4000")))
  expect_false(is_own_site(request("null")))
  expect_false(is_own_site(request(NULL)))
  # Behind a server that passes on what the browser asks for.
  expect_true(is_own_site(request("https://lab.example", HTTP_X_FORWARDED_HOST = "lab.example")))
  expect_true(is_own_site(request("https://lab.example:8787",
                                  HTTP_X_RSTUDIO_REQUEST = "https://lab.example:8787/p/1a2b/")))
  expect_false(is_own_site(request("https://evil.example", HTTP_X_FORWARDED_HOST = "lab.example")))
})

test_that("a token is new each time, leaves random numbers alone, is asked for by page, server", {
  skip_if_not_installed("shiny")
  set.seed(1)
  before <- .Random.seed
  token <- random_token()
  expect_identical(.Random.seed, before)
  expect_match(token, "^[0-9a-f]{32}$")
  expect_false(token == random_token())
  expect_true(has_token(paste0("?token=", token), token))
  for (query in list("", NULL, "?token=", "?token=x", paste0("?other=", token))) {
    expect_false(has_token(query, token))
  }
  page <- guarded_page("the page", token)
  expect_equal(page(list(QUERY_STRING = paste0("?token=", token))), "the page")
  expect_equal(page(list(QUERY_STRING = ""))$status, 403)
})

test_that("the address with the token is given to a function, or printed", {
  said <- NULL
  open_page("http://127.0.0.1:1/?token=a", function(url) said <<- url)
  expect_equal(said, "http://127.0.0.1:1/?token=a")
  expect_message(open_page("http://127.0.0.1:1/?token=a", FALSE), "?token=a", fixed = TRUE)
})

# What a browser does with the page of a review in another process, by hand: opens the socket from
# `origin`, shows the server `search` as its address, and asks for `landmark` to be taken away and
# the review to end.
# `midway` is called when the socket is open.
answer_review <- function(port, origin, search, landmark = "a", midway = NULL) {
  socket <- socketConnection("127.0.0.1", port, open = "r+b", blocking = TRUE, timeout = 10)
  on.exit(close(socket))
  head <- c("GET /websocket/ HTTP/1.1", sprintf("Host: 127.0.0.1:%d", port), "Upgrade: websocket",
            "Connection: Upgrade", "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
            "Sec-WebSocket-Version: 13", paste("Origin:", origin), "", "")
  writeBin(charToRaw(paste(head, collapse = "\r\n")), socket)
  answer <- readBin(socket, "raw", 12)
  Sys.sleep(0.5)
  say <- function(method, ...) {
    text <- charToRaw(jsonlite::toJSON(list(method = method, data = list(...)), auto_unbox = TRUE))
    n <- length(text)
    # A masked frame; the mask is nought.
    writeBin(c(as.raw(0x81), if (n < 126) as.raw(128 + n) else as.raw(c(254, n %/% 256, n %% 256)),
               raw(4), text), socket)
    Sys.sleep(0.5)
  }
  try({
    say("init", "absent:shiny.action" = 0, "done:shiny.action" = 0, .clientdata_url_search = search,
        .clientdata_output_list_hidden = FALSE, .clientdata_output_face_hidden = TRUE,
        .clientdata_pixelratio = 1)
    if (!is.null(midway)) midway()
    say("update", select = landmark)
    say("update", "absent:shiny.action" = 1)
    say("update", "done:shiny.action" = 1)
  }, silent = TRUE)
}

test_that("a review in another process obeys its own page, and nobody else", {
  skip_on_cran()
  skip_if_not_installed("shiny")
  skip_if_not_installed("httpuv")
  skip_on_os("windows")
  port <- httpuv::randomPort()
  address <- tempfile()
  result <- tempfile()
  saveRDS(list(specimen = quad_specimen(), scheme = quad_scheme()),
          input <- tempfile(fileext = ".rds"))
  code <-
    sprintf(paste(paste("options(rgl.useNULL = TRUE); x <- readRDS('%s'); cat(Sys.getpid(), file =",
                        "'%s.pid')"),
                  "r <- crestline::review_landmarks(x$specimen, x$scheme, port = %dL,",
                  "  launch.browser = function(url) writeLines(url, '%s'))",
                  "saveRDS(r$landmarks, '%s')", sep = "\n"), input, input, port, address, result)
  on.exit(if (file.exists(paste0(input, ".pid")))
    tools::pskill(scan(paste0(input, ".pid"), quiet = TRUE)))
  script <- tempfile(fileext = ".R")
  writeLines(code, script)
  system2(file.path(R.home("bin"), "Rscript"), script, wait = FALSE, stdout = FALSE, stderr = FALSE)
  waits_for <- function(file, seconds) {
    end <- Sys.time() + seconds
    while (!file.exists(file) && Sys.time() < end) Sys.sleep(0.2)
    file.exists(file)
  }
  skip_if_not(waits_for(address, 120), "a port for the page")
  Sys.sleep(0.5)
  query <- sub("^[^?]*", "", readLines(address))
  own <- sprintf("http://127.0.0.1:%d", port)
  answer_review(port, "http://evil.example", query)
  answer_review(port, own, "?token=0123")
  expect_false(waits_for(result, 1))
  # A second tab of the address is closed: what it asks for is not done.
  answer_review(port, own, query, midway = function() {
    answer_review(port, own, query, "b")
    expect_false(file.exists(result))
  })
  expect_true(waits_for(result, 20))
  Sys.sleep(0.2)
  landmarks <- readRDS(result)
  expect_true(all(is.na(landmarks["a", ])))
  expect_false(anyNA(landmarks[c("b", "c", "d"), ]))
  unlink(c(address, result, input, paste0(input, ".pid"), script))
})

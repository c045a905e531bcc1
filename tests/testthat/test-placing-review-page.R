# A click on a place, seen from an eye.
ray_to <- function(mesh, at, eye) {
  ends <- into_scene(rbind(eye, at), scene_frame(mesh))
  list(from = as.list(ends[1, ]), towards = as.list(ends[2, ]))
}

# The server of a page, and what it returns at its end.
serve_review <- function(review) {
  returned <- new.env()
  surfaces <- desk_surfaces("plain", review_settings(radius = 10), "front")
  list(server = desk_server(desk_of(review), surfaces,
                            function(specimen) returned$specimen <- specimen),
       returned = returned)
}

test_that("clicks choose and move a landmark, its curves follow, and the specimen comes back", {
  skip_if_not_installed("shiny")
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  scheme <- face_scheme()
  begun <- begin_review(face, scheme, 0.5, ridge_settings(error = FALSE), 0.2, 1)
  served <- serve_review(begun)
  at <- face$landmarks["chL", ]
  target <- unlist(surface_points(face$mesh, matrix(at + c(4, 3, 0), 1))[1:3])
  ray <- function(at) ray_to(face$mesh, at, at + c(10, 10, 300))
  shiny::testServer(served$server, {
    session$setInputs(ready = TRUE)
    paths <- lapply(current_review(review())$fitting$fits, `[[`, "path")
    session$setInputs(ray = ray(target))
    expect_identical(current_review(review())$specimen, begun$specimen)  # nothing is chosen
    session$setInputs(ray = ray(at))
    expect_equal(current_review(review())$selected, "chL")
    session$setInputs(ray = ray(target))
    expect_equal(current_review(review())$specimen$landmarks["chL", ], target, tolerance = 1e-8)
    now <- lapply(current_review(review())$fitting$fits, `[[`, "path")
    changed <- !mapply(identical, now, paths)
    expect_setequal(names(which(changed)),
                    scheme$curves$curve[scheme$curves$from == "chL" | scheme$curves$to == "chL"])
    expect_match(as.character(output$chosen$html), "corner of the mouth")
    expect_match(as.character(output$list$html), "placed")
    session$setInputs(undo = 1)
    expect_identical(current_review(review())$specimen, begun$specimen)
    session$setInputs(ray = ray(target), done = 1)
    session$setInputs(cancel = 1)
  })
  expect_on_mesh(landmark_point(served$returned$specimen, "chL"), face$mesh)
  expect_equal(served$returned$specimen$landmarks["chL", ], target, tolerance = 1e-8)
  others <- setdiff(rownames(face$landmarks), "chL")
  expect_identical(served$returned$specimen$landmarks[others, ], face$landmarks[others, ])
})

test_that("placing names the next; cancel gives back what there was, closing what there is", {
  skip_if_not_installed("shiny")
  bare <- without_landmarks(quad_specimen(), quad_scheme())
  review <- begin_review(bare, quad_scheme(), 0.5, ridge_settings(error = FALSE), 0.2, 1)
  review$selected <- next_open(review)
  served <- serve_review(review)
  place <- function(session, name) {
    at <- quad_corners()[name, ]
    session$setInputs(ray = ray_to(bare$mesh, at, 3 * at))
  }
  shiny::testServer(served$server, {
    session$setInputs(ready = TRUE)
    for (name in c("a", "b", "c")) {
      expect_equal(current_review(review())$selected, name)
      place(session, name)
    }
    fits <- current_review(review())$fitting$fits
    expect_setequal(names(Filter(function(fit) !is.null(fit$path), fits)),
                    c("bottom", "right"))
  })
  expect_lt(max(abs(served$returned$specimen$landmarks[1:3, ] - quad_corners()[1:3, ])), 0.1)
  expect_true(all(is.na(served$returned$specimen$landmarks["d", ])))
  shiny::testServer(served$server, {
    place(session, "a")
    session$setInputs(cancel = 1)
  })
  expect_identical(served$returned$specimen, review$specimen)
})

test_that("the page has what its script and its server look for", {
  skip_if_not_installed("shiny")
  html <- as.character(review_page("Landmarks of <a>"))
  for (id in c("face", "chosen", "list", "keep", "absent", "undo", "done", "cancel")) {
    expect_match(html, sprintf('id="%s"', id))
  }
  expect_match(html, "Landmarks of &lt;a&gt;")
  expect_match(html, "sceneChange")
})

test_that("the page says who is chosen, where it belongs, what waits, sides exchanged", {
  skip_if_not_installed("shiny")
  face <- specimen(humface_scan(), humface_landmarks(), id = "humface")
  review <- begin_review(face, face_scheme(), 0.5, ridge_settings(error = FALSE), 0.2, 1)
  expect_match(as.character(chosen_html(review)), "Choose a landmark")
  review <- select_landmark(review, "enR")
  said <- as.character(chosen_html(review))
  for (words in c("endocanthion", "inner corner of the eye fissure", "3 curves end here",
                  "No landmark is missing")) expect_match(said, words)
  expect_no_match(said, "mirrored")
  rownames(face$landmarks) <- chartr("LR", "RL", rownames(face$landmarks))
  swapped <- begin_review(face, face_scheme(), 0.5, ridge_settings(error = FALSE), 0.2, 1)
  expect_match(as.character(chosen_html(swapped)), "Left and right look mirrored")
})

test_that("absent ears: the page says how many curves and surface points they cost", {
  skip_if_not_installed("shiny")
  ears <- c("tL", "tR", "oiL", "oiR")
  at <- humface_landmarks()[, 1:3]
  at[ears, ] <- NA
  face <- specimen(humface_scan(), at, id = "humface")
  review <- begin_review(face, face_scheme(), 0.5, ridge_settings(error = FALSE), 0.2, 1)
  review$state[ears] <- "absent"
  # 672 of a measured face without ears are missing, tests of fit_shape() aside
  expect_match(done_words(review), "10 curves and 672 of 922 surface points cannot be measured")
  html <- as.character(list_html(review))
  expect_match(html, "unseen[^>]*title=\"there is no line")
  # In plain words where the definition is easily misread; others as the scheme has them
  expect_match(as.character(chosen_html(select_landmark(review, "acR"))), "where the wing of the")
  expect_no_match(as.character(chosen_html(select_landmark(review, "pn"))), "from the side")
})

test_that("the page says at its end where the work is, and what the colours of lines mean", {
  skip_if_not_installed("shiny")
  dir <- tempfile("desk")
  expect_match(as.character(review_page("a")), "data-kept=\"The landmarks and curves are the value")
  expect_match(desk_kept(dir), basename(dir), fixed = TRUE)
  expect_no_match(desk_kept(NULL), "folder")
  for (kind in c("ridge", "valley", "plane")) {
    expect_match(as.character(line_colours()), paste0("background:", kind_colours[[kind]]),
                 fixed = TRUE)
  }
})

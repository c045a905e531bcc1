# What is doubted, of good faces and of what is no face: `CRESTLINE_SHARED=../shared/data Rscript
# bench/doubt.R good|none|exchanged [every=1]`, of every so many of the faces.
library(crestline)
options(rgl.useNULL = TRUE)
data <- Sys.getenv("CRESTLINE_SHARED")
asked <- commandArgs(TRUE)
what <- c(grep("=", asked, value = TRUE, invert = TRUE), "good")[1]
every <- as.integer(c(sub("every=", "", grep("^every=", asked, value = TRUE)), 1)[1])
scheme <- face_scheme()
packaged <- function(file) read_landmarks(system.file("extdata", file, package = "crestline"))

# Value and classes of the warnings of some code; those of single curves are left out.
heard <- function(code) {
  told <- character()
  value <- withCallingHandlers(tryCatch(code, crestline_error = identity),
                               crestline_warning = function(w) {
                                 told <<- c(told, class(w)[1])
                                 invokeRestart("muffleWarning")
                               })
  list(value = value, told = setdiff(told, c("crestline_undetermined", "crestline_rival_path")))
}

# Landmarks by specimen of a folder of the shared data.
placed <- function(folder) {
  table <- read.csv(file.path(data, folder, "landmarks.csv"))
  if (is.null(table$id)) table$id <- "surface"
  lapply(split(table, table$id), function(own)
    structure(as.matrix(own[c("x", "y", "z")]), dimnames = list(own$landmark, c("x", "y", "z"))))
}

good_faces <- function() {
  faces <- lapply(c("scan_a", "template_male", "simpop", "ict"), function(folder) {
    own <- placed(folder)
    Map(function(at, id) read_specimen(file.path(data, folder, paste0(id, ".ply")), at,
                                       id = paste(folder, id)), own, names(own))
  })
  humface <- get(data(humface, package = "Rvcg", envir = environment()))
  all <- c(list(specimen(humface, packaged("humface_landmarks.csv"), id = "humface")),
           unlist(faces, recursive = FALSE))
  all[seq(1, length(all), every)]
}

no_faces <- function() {
  ball <- Rvcg::vcgSphere(5)
  set.seed(3)
  at <- matrix(rnorm(60), 20)
  near <- t(ball$vb[1:3, ]) %*% t(at / sqrt(rowSums(at^2)))
  bumps <- ball
  bumps$vb[1:3, ] <- t(t(ball$vb[1:3, ]) * (90 + drop(exp(60 * (near - 1)) %*% runif(20, 5, 15))))
  data(dummyhead, package = "Rvcg", envir = environment())
  data(boneData, package = "Morpho", envir = environment())
  face <- packaged("dummyhead_landmarks.csv")
  front <- colMeans(face[c("pn", "sn", "n", "exL", "exR"), ]) - rowMeans(dummyhead.mesh$vb[1:3, ])
  behind <- drop(front %*% (dummyhead.mesh$vb[1:3, ] - rowMeans(dummyhead.mesh$vb[1:3, ]))) < 0
  back <- structure(list(vb = dummyhead.mesh$vb,
                         it = dummyhead.mesh$it[, colSums(matrix(behind[dummyhead.mesh$it], 3)) ==
                                                  3]), class = "mesh3d")
  list("ball with bumps" = bumps, skull = skull_0144_ch_fe.mesh, "head from behind" = back)
}

graded <- function(one, kind, told = character()) {
  fit <- heard(fit_shape(one, scheme, progress = FALSE))
  grade <- quality(fit$value)
  green <- tapply(grade$grade == "green",
                  factor(grade$level, c("landmarks", "curves", "surface")), sum)
  data.frame(id = one$id, kind = kind, t(green), warnings = toString(c(told, fit$told)))
}

found <- function(mesh, id) {
  finding <- heard(find_landmarks(mesh, id = id))
  if (inherits(finding$value, "error"))
    return(data.frame(id = id, kind = "refused", landmarks = 0, curves = 0, surface = 0,
                      warnings = ""))
  graded(finding$value, "found", finding$told)
}

# How many of all exchanges of two landmarks are named by the scheme.
exchanged <- function(one) {
  names <- rownames(one$landmarks)
  both <- utils::combn(names, 2)
  right <- apply(both, 2, function(two) {
    at <- one$landmarks
    rownames(at)[match(two, names)] <- rev(two)
    slips <- crestline:::exchanged_landmarks(at, NULL, crestline:::side_pairs(names), character(),
                                             crestline:::typical_landmarks(scheme))
    setequal(unlist(slips$groups), two)
  })
  data.frame(id = one$id, exchanges = length(right), named = sum(right))
}

rows <- switch(what,
  good = unlist(lapply(good_faces(), function(one) {
    list(graded(one, "placed"), found(one$mesh, one$id))
  }), recursive = FALSE),
  none = Map(found, no_faces(), names(no_faces())),
  exchanged = lapply(good_faces(), exchanged))
print(do.call(rbind, rows), row.names = FALSE)

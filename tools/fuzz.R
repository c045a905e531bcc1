# Damaged meshes, files, objects and arguments through the whole package: each must give a value or
# a crestline_error.
#
#   Rscript tools/fuzz.R [cases = 2000] [first seed = 1]
#
# Uses the installed crestline. Runs in child processes, so that a crash of R is caught and counted;
# ends with status 1 if anything but a value or a crestline_error came out. One case again:
#   Rscript tools/fuzz.R --case SEED

pick <- function(x, size = 1, prob = NULL) x[sample.int(length(x), size, size > length(x), prob)]

# A bumpy patch with four landmarks: its ridge runs between a and b.
sound_case <- function(n = 14) {
  at <- expand.grid(x = seq(-1, 1, length.out = n), y = seq(-1, 1, length.out = n))
  low <- as.vector(outer(seq_len(n - 1), (seq_len(n - 1) - 1) * n, "+"))
  it <- cbind(rbind(low, low + 1, low + n), rbind(low + 1, low + n + 1, low + n))
  z <- function(x, y) -(x - 0.3 * y^3)^2
  mesh <- structure(list(vb = rbind(at$x, at$y, z(at$x, at$y), 1), it = matrix(as.integer(it), 3)),
                    class = "mesh3d")
  y <- c(a = -0.9, b = 0.9, c = 0.1, d = 0)
  x <- c(0.3 * y[c("a", "b")]^3, 0.5, 0)
  landmarks <- cbind(x = x, y = y, z = z(x, y))
  rownames(landmarks) <- names(y)
  list(mesh = mesh, landmarks = landmarks)
}

mesh_mutations <- list(
  bad_indices = function(m) {
    i <- sample(length(m$it), 3)
    m$it[i] <- pick(c(0L, -1L, NA, 10000L, .Machine$integer.max), 3)
    m
  },
  non_finite = function(m) {
    i <- sample(length(m$vb), sample(20, 1))
    m$vb[i] <- pick(c(NaN, Inf, -Inf, NA), length(i))
    m
  },
  duplicate_faces = function(m) {
    m$it <- cbind(m$it, m$it[sample(3), sample(ncol(m$it), 30, TRUE)])
    m
  },
  degenerate_faces = function(m) {
    i <- sample(ncol(m$it), 40)
    m$it[1, i] <- m$it[2, i]
    m
  },
  random_faces = function(m) {
    m$it <- cbind(m$it, matrix(sample(ncol(m$vb), 60, TRUE), 3))
    m
  },
  missing_faces = function(m) {
    m$it <- m$it[, runif(ncol(m$it)) > runif(1), drop = FALSE]
    m
  },
  cut_in_two = function(m) {
    m$it <- m$it[, abs(m$vb[2, m$it[1, ]] - runif(1, -0.8, 0.8)) > 0.16, drop = FALSE]
    m
  },
  turned_faces = function(m) {
    i <- which(runif(ncol(m$it)) < runif(1))
    m$it[2:3, i] <- m$it[3:2, i]
    m
  },
  scaled = function(m) {
    m$vb[1:3, ] <- m$vb[1:3, ] * 10^runif(1, -30, 30)
    m
  },
  stretched = function(m) {
    m$vb[1:3, ] <- m$vb[1:3, ] * 10^runif(3, -12, 12)
    m
  },
  shifted = function(m) {
    m$vb[1:3, ] <- m$vb[1:3, ] + 10^runif(3, 0, 12)
    m
  },
  squashed = function(m) {
    m$vb[sample(3, sample(3, 1)), ] <- 0
    m
  },
  collapsed = function(m) {
    i <- sample(ncol(m$vb), 100)
    m$vb[, i] <- m$vb[, i[1]]
    m
  },
  homogeneous = function(m) {
    m$vb[4, ] <- pick(c(0, 2, -1, NA, 1e-300), ncol(m$vb))
    m
  },
  noisy = function(m) {
    m$vb[1:3, ] <- m$vb[1:3, ] + rnorm(3 * ncol(m$vb), 0, 10^runif(1, -6, 2))
    m
  },
  cloud = function(m) {
    m$it <- NULL
    m$vb <- m$vb[, seq_len(sample(ncol(m$vb), 1)), drop = FALSE]
    m
  },
  few_faces = function(m) {
    m$it <- m$it[, seq_len(sample(0:3, 1)), drop = FALSE]
    m
  },
  wrong_shape = function(m) {
    m$it <- pick(list(matrix(1:8, 2), 1:3, 1:7, "a", matrix(1.5, 3, 2), list(1),
                      matrix(TRUE, 3, 1)))[[1]]
    m
  },
  wrong_vertices = function(m) {
    m$vb <- pick(list(NULL, 1:3, matrix("a", 4, 9), matrix(0, 2, 9), matrix(1i, 4, 9),
                      m$vb[, 0]))[[1]]
    m
  },
  quads = function(m) {
    m$ib <- matrix(sample(c(0L, seq_len(ncol(m$vb))), 40, TRUE), 4)
    m
  },
  colours = function(m) {
    m$material <- list(color = pick(list("red", character(5), NA, 1:196, list())) [[1]])
    m
  },
  none = function(m) m
)

landmark_mutations <- list(
  none = function(x) x,
  absent = function(x) x[sample(0:2, 1), , drop = FALSE],
  non_finite = function(x) {
    x[sample(length(x), 2)] <- pick(c(NA, NaN, Inf), 2)
    x
  },
  twice = function(x) {
    rownames(x)[2] <- rownames(x)[1]
    x
  },
  same = function(x) {
    x[2, ] <- x[1, ]
    x
  },
  nameless = function(x) unname(x),
  off = function(x) {
    x[1, ] <- x[1, ] + rnorm(3)
    x
  },
  unit = function(x) x * 10^sample(c(-30, -3:3, 30), 1),
  odd = function(x) pick(list(NULL, "a", 1:3, list(), data.frame(a = 1),
                              data.frame(name = "a", x = "b", y = 1, z = 2)))[[1]]
)

# Bytes changed, put in, taken out, cut off; numbers in the text replaced by troublesome ones.
byte_mutations <- list(
  flip = function(r) {
    i <- sample(length(r), min(length(r), sample(20, 1)))
    r[i] <- as.raw(sample(0:255, length(i), TRUE))
    r
  },
  head = function(r) {
    i <- sample(min(length(r), 250), sample(4, 1))
    r[i] <- as.raw(sample(0:255, length(i), TRUE))
    r
  },
  insert = function(r) append(r, as.raw(sample(0:255, sample(50, 1), TRUE)), sample(length(r), 1)),
  remove = function(r) {
    i <- sample(length(r), 1)
    r[-seq(i, min(length(r), i + sample(60, 1)))]
  },
  truncate = function(r) r[seq_len(sample(0:length(r), 1))],
  random = function(r) as.raw(sample(0:255, sample(2000, 1), TRUE)),
  numbers = function(r) {
    if (any(r == 0)) return(r[seq_len(length(r) / 2)])
    word <- strsplit(rawToChar(r), "(?<=[ \n,/])", perl = TRUE, useBytes = TRUE)[[1]]
    i <- sample(length(word), min(length(word), sample(5, 1)))
    odd <- c("nan ", "-1 ", "0 ", "99999999999999999999 ", "1e400 ", "x ", "-2147483648 ",
             "4294967295 ", "\n", "1.5 ", "\"", "/")
    word[i] <- pick(odd, length(i))
    charToRaw(paste(word, collapse = ""))
  }
)

landmark_kinds <- c("csv", "pts", "tps", "nts", "dta", "landmarkAscii", "fcsv", "mrk.json")

# Landmarks, one of them missing at times, with curves where the format has them.
write_landmark_case <- function(case, kind, file) {
  x <- case$landmarks
  if (runif(1) < 0.3) x["d", ] <- NA
  curves <- if (kind %in% c("csv", "pts", "tps", "mrk.json")) {
    list(C000 = x[1:2, ], C001 = structure(x[c(1, 3, 2), ], closed = kind != "pts"))
  }
  crestline::write_landmarks(x, file, curves)
}

write_case <- function(case, kind) {
  stem <- tempfile()
  file <- paste0(stem, ".", sub("_.*", "", kind))
  switch(kind,
    ply_ascii = Rvcg::vcgPlyWrite(case$mesh, stem, binary = FALSE),
    ply_binary = Rvcg::vcgPlyWrite(case$mesh, stem, binary = TRUE),
    obj = Rvcg::vcgObjWrite(case$mesh, stem),
    stl_ascii = Rvcg::vcgStlWrite(case$mesh, stem, binary = FALSE),
    stl_binary = Rvcg::vcgStlWrite(case$mesh, stem, binary = TRUE),
    write_landmark_case(case, kind, file)
  )
  file
}

# Files as they are in the wild: written anew by hands of their own, so that the same mesh must come
# out, or, where `told`, a warning or a refusal.
wild_lines <- list(
  comments = function(x, kind) if (kind == "obj") c("# C:\\dir\\",
                                                    ifelse(runif(length(x)) < 0.3,
                                                           paste(x, "# 1 2 3"), x)) else x,
  continued = function(x, kind) if (kind == "obj") ifelse(runif(length(x)) < 0.3,
                                                          sub(" ([^ ]+)$", " \\\\\n\\1", x),
                                                          x) else x,
  other_lines = function(x, kind) if (kind == "obj") c("mtllib none.mtl", "o a", x, "l 1 2", "p 1",
                                                       "g b") else x,
  negative = function(x, kind) if (kind == "obj") negative_faces(x) else x,
  capitals = function(x, kind) if (kind == "stl") toupper(x) else x,
  names = function(x, kind) if (kind == "stl") c("solid facet vertex 1 2 3", x[-c(1, length(x))],
                                                 "endsolid vertex") else x,
  header = function(x, kind) if (kind == "ply") append(x,
                                                       rep("comment end_header of old",
                                                           pick(c(3, 4000))), 2) else x,
  blanks = function(x, kind) if (kind == "ply") c("ply",
                                                  wild_blanks(x[-1], "")) else wild_blanks(x),
  empty_lines = function(x, kind) if (kind == "ply") x else as.vector(rbind(x, "")),
  exponents = function(x, kind) gsub("([ ^])([0-9][.][0-9]+)( |$)", "\\1\\2E+00\\3", x)
)

# No blank stands before a word of a PLY header.
wild_blanks <- function(x, before = c("", " ", "\t")) {
  paste0(pick(before, length(x)), gsub(" ", pick(c("  ", "\t")), x), pick(c("", " "), length(x)))
}

negative_faces <- function(x) {
  face <- startsWith(x, "f ")
  n <- sum(startsWith(x, "v "))
  corner <- strsplit(x[face], " ")
  x[face] <- vapply(corner,
                    function(w) paste("f", paste(as.integer(w[-1]) - n - 1L, collapse = " ")), "")
  x
}

wild_bytes <- list(
  none = function(r) r,
  returns = function(r) {
    r[r == 10] <- as.raw(13)
    r
  },
  both = function(r) charToRaw(gsub("\n", "\r\n", rawToChar(r), fixed = TRUE)),
  mark = function(r) c(as.raw(c(0xef, 0xbb, 0xbf)), r),
  wide = function(r) as.vector(rbind(r, as.raw(0))),
  wide_mark = function(r) c(as.raw(c(0xfe, 0xff)), as.vector(rbind(as.raw(0), r)))
)

wild_told <- list(
  none = function(x, kind) x,
  commas = function(x, kind) {
    i <- grepl("^ *(v|vertex|[-0-9.]+) ", x)
    x[i] <- gsub("([0-9])[.]([0-9])", "\\1,\\2", x[i])
    x
  },
  half_index = function(x, kind) if (kind == "obj") sub("^f ([0-9]+) .*", "f \\1 2 3.5",
                                                        x) else wild_told$commas(x, kind),
  count = function(x, kind) if (kind == "ply") sub("element vertex .*",
                                                   paste("element vertex", sample(400, 1)),
                                                   x) else wild_told$commas(x, kind),
  windows = function(x, kind) {
    i <- utils::tail(grep("^ *(v|vertex|[-0-9.]+) [-0-9.]+ [-0-9.]+", x), 3)
    x[i] <- sub(" [-0-9.e+]+", " -1.#IND00", x[i])
    x
  }
)

# What a case of the wild did to a mesh: "" where it came out right or was told of, else what is
# wrong.
wild_case <- function(tell) {
  case <- sound_case()
  kind <- pick(c("ply", "obj", "stl"))
  file <- tempfile(fileext = paste0(".", kind))
  crestline::write_mesh(case$mesh, file, ascii = TRUE)
  true <- crestline::read_specimen(file, case$landmarks, outward = "keep", tolerance = 0.05)
  line <- readLines(file)
  told <- pick(names(wild_told), prob = c(4, 1, 1, 1, 1))
  changes <- sample(names(wild_lines), sample(0:3, 1))
  bytes <- pick(names(wild_bytes))
  packed <- runif(1) < 0.2
  tell(paste("wild", kind, if (told == "none") "as it was" else told))
  for (name in changes) line <- wild_lines[[name]](line, kind)
  raw <- wild_bytes[[bytes]](charToRaw(paste0(paste(wild_told[[told]](line, kind), collapse = "\n"),
                                       "\n")))
  if (packed) file <- paste0(file, ".gz")
  connection <- if (packed) gzfile(file, "wb") else file(file, "wb")
  writeBin(raw, connection)
  close(connection)
  on.exit(unlink(file))
  warned <- FALSE
  got <- withCallingHandlers(crestline::read_specimen(file, case$landmarks, outward = "keep",
                                                      tolerance = 0.05),
                             warning = function(w) {
                               warned <<- TRUE
                               invokeRestart("muffleWarning")
                             })
  same <- identical(dim(got$mesh$it), dim(true$mesh$it)) &&
    isTRUE(all.equal(got$mesh$vb[, got$mesh$it], true$mesh$vb[, true$mesh$it]))
  silent <- !warned && got$report$count[got$report$check == "non-finite co-ordinates"] == 0
  if (!same &&
      silent) stop(paste(c("another mesh without a word:", kind, changes, bytes, told),
                         collapse = " "))
  if (told == "none" &&
      (!same || warned)) stop(paste(c("not the same mesh:", kind, changes, bytes), collapse = " "))
  got
}

damage_file <- function(file) {
  raw <- readBin(file, "raw", file.size(file))
  change <- pick(names(byte_mutations))
  writeBin(byte_mutations[[change]](raw), file)
  change
}

# A specimen from one seed; `tell` gets the words for what was done.
make_specimen <- function(tell) {
  if (runif(1) < 0.15) return(wild_case(tell))
  case <- sound_case()
  kind <- pick(c("memory", "memory", "memory", "ply_ascii", "ply_binary", "obj", "stl_ascii",
                 "stl_binary", landmark_kinds),
               prob = c(rep(1, 8), rep(0.25, length(landmark_kinds))))
  if (kind == "memory") {
    change <- c(pick(names(mesh_mutations), sample(2, 1)),
                pick(if (runif(1) < 0.6) "none" else names(landmark_mutations)))
    tell(paste("memory", change[1]))
    for (name in utils::head(change, -1)) {
      # A second change may not be possible after the first.
      case$mesh <- tryCatch(mesh_mutations[[name]](case$mesh), error = function(e) case$mesh)
    }
    landmarks <- landmark_mutations[[utils::tail(change, 1)]](case$landmarks)
    return(crestline::specimen(case$mesh, landmarks, id = "fuzz", tolerance = 0.05))
  }
  file <- write_case(case, kind)
  on.exit(unlink(file))
  tell(paste(kind, damage_file(file)))
  if (kind %in% landmark_kinds) return(crestline::specimen(case$mesh,
                                                           crestline::read_landmarks(file),
                                                           tolerance = 0.05))
  crestline::read_specimen(file, case$landmarks, tolerance = 0.05)
}

# An object of the package without a part that it needs, or with something else in its place.
damage_object <- function(x, class) {
  part <- pick(names(get("class_parts", asNamespace("crestline"))[[class]]))
  x <- unclass(x)
  x[part] <- pick(list(NULL, NA, list(), quote(a), TRUE))
  structure(x, class = class)
}

# What is done with a whole specimen, shape, scheme or curve is done with a damaged one.
use_damaged <- function(tell) {
  case <- sound_case()
  specimen <- crestline::specimen(case$mesh, case$landmarks, id = "fuzz", tolerance = 0.05)
  scheme <- crestline::curve_scheme(data.frame(landmark = rownames(case$landmarks)),
                                    data.frame(curve = "ab", from = "a", to = "b", kind = "plane",
                                               n = 5))
  shape <- crestline::fit_shape(specimen, scheme, progress = FALSE)
  kind <- pick(c("specimen", "shape", "curve_scheme", "curve"))
  tell(paste("damaged", kind))
  switch(kind,
    specimen = crestline::fit_shape(damage_object(specimen, kind), scheme, progress = FALSE),
    curve_scheme = crestline::fit_shape(specimen, damage_object(scheme, kind), progress = FALSE),
    shape = pick(list(crestline::coords, crestline::write_landmarks))[[1]](damage_object(shape,
                                                                                         kind),
                                                                                         "curves"),
    curve = {
      curve <- crestline::ridge_curve(specimen, "a", "b", "plane", n = 5)
      crestline::plot_curves(damage_object(curve, kind), specimen, "plain", engine = "picture")
    }
  )
}

# Any argument of any function with a wrong value, from the table of the tests.
use_wrong_argument <- function(tell) {
  if (is.null(argument_table$calls)) {
    argument_table$calls <- suppressWarnings(argument_table$argument_calls())
  }
  calls <- Filter(function(one) length(one$kinds) > 0, argument_table$calls)
  fn <- pick(names(calls))
  argument <- pick(names(calls[[fn]]$kinds))
  wrong <- argument_table$wrong_values()
  value <- pick(names(wrong))
  tell(sprintf("argument %s(%s)", fn, argument))
  args <- calls[[fn]]$args
  args[argument] <- wrong[value]
  utils::capture.output(do.call(getExportedValue("crestline", fn), args, quote = TRUE))
}

# All that can be done with a specimen, as far as this version of the package can.
use_specimen <- function(specimen) {
  has <- function(name) name %in% getNamespaceExports("crestline")
  utils::capture.output(print(specimen))
  size <- sqrt(sum(apply(specimen$mesh$vb[1:3, , drop = FALSE], 1, function(v) diff(range(v)))^2))
  type <- pick(c("ridge", "valley", "plane"))
  radius <- size * pick(c(0.1, 0.15, 0.2, 1e-3, 2), prob = c(3, 3, 3, 1, 1))
  if (has("curvature")) crestline::curvature(specimen$mesh, radius)
  if (has("reference_path")) crestline::reference_path(specimen, "a", "b", type, radius)
  if (has("ridge_curve")) crestline::ridge_curve(specimen, "a", "b", type, radius, width = size / 8,
                                                 n = 11)
}

# "returned", "refused", or the message of a failure.
run_case <- function(seed, tell = function(words) NULL) {
  set.seed(seed)
  setTimeLimit(elapsed = 60, transient = TRUE)
  on.exit(setTimeLimit())
  tryCatch(
    suppressWarnings({
      odd <- pick(list(use_damaged, use_wrong_argument))[[1]]
      if (runif(1) < 0.1) odd(tell) else use_specimen(make_specimen(tell))
      "returned"
    }),
    crestline_error = function(e) paste("refused:", e$stage, e$problem),
    error = function(e) paste("FAILED:", gsub("\\s+", " ", conditionMessage(e)), "in",
                              paste(deparse(conditionCall(e))[1]))
  )
}

# The child's work: a line before each case and one after, so that the parent sees where it died.
run_cases <- function(seeds, log) {
  say <- function(...) cat(iconv(c(...), "UTF-8", "ASCII", sub = "byte"), "\n", sep = "\t",
                           file = log, append = TRUE)
  for (seed in seeds) {
    say(seed, "start")
    say(seed, "end", run_case(seed, function(words) say(seed, "what", words)))
  }
}

# Children take the cases one after the other; after a crash the next child goes on behind it.
run_all <- function(seeds, script, cases_a_child = 250) {
  log <- tempfile()
  file.create(log)
  while (length(seeds)) {
    now <- utils::head(seeds, cases_a_child)
    status <- system2("Rscript",
                      c("--vanilla", shQuote(script), "--child", min(now), max(now), shQuote(log)),
                      stdout = FALSE, stderr = FALSE, timeout = 60 * length(now))
    lines <- read_log(log)
    begun <- unique(lines$seed[lines$mark == "start"])
    if (status != 0) {
      dead <- setdiff(now, lines$seed[lines$mark == "end"])[1]
      cat(dead, "end", sprintf("CRASHED: status %d", status), "\n", sep = "\t", file = log,
          append = TRUE)
      begun <- c(begun, dead)
    }
    seeds <- setdiff(seeds, begun)
    cat(sprintf("%d cases to go\n", length(seeds)))
  }
  read_log(log)
}

read_log <- function(log) {
  # A message that quotes a damaged file may hold line ends: only whole lines count.
  part <- strsplit(grep("^[0-9]+\t[a-z]+\t", readLines(log, warn = FALSE), value = TRUE,
                        useBytes = TRUE), "\t", fixed = TRUE)
  data.frame(seed = as.integer(vapply(part, `[`, "", 1)), mark = vapply(part, `[`, "", 2),
             text = vapply(part, `[`, "", 3))
}

summarise <- function(log) {
  end <- log[log$mark == "end", ]
  what <- log$text[log$mark == "what"][match(end$seed, log$seed[log$mark == "what"])]
  bad <- grepl("^(FAILED|CRASHED)", end$text)
  outcome <- sub(":.*", "", end$text)
  print(table(what = ifelse(is.na(what), "before the change", what), outcome))
  cat("Most frequent reasons to refuse:\n")
  reasons <- sort(table(gsub("[-0-9.]+", "#", end$text[outcome == "refused"])), decreasing = TRUE)
  print(as.data.frame(utils::head(reasons, 15)))
  for (i in which(bad)) cat("seed ", end$seed[i], " (", what[i], "): ", end$text[i], "\n", sep = "")
  cat(sprintf("%d cases: %d returned, %d refused, %d failed or crashed\n",
              nrow(end), sum(outcome == "returned"), sum(outcome == "refused"), sum(bad)))
  sum(bad)
}

arguments <- commandArgs(TRUE)
script <- sub("^--file=", "", grep("^--file=", commandArgs(FALSE), value = TRUE))
argument_table <- new.env()
suppressPackageStartupMessages(attachNamespace("crestline"))
sys.source(file.path(dirname(script), "..", "tests", "testthat", "helper-arguments.R"),
           argument_table)
if (identical(arguments[1], "--child")) {
  run_cases(as.integer(arguments[2]):as.integer(arguments[3]), arguments[4])
} else if (identical(arguments[1], "--case")) {
  cat(run_case(as.integer(arguments[2]), function(words) cat(words, "\n")), "\n")
} else {
  cases <- as.integer(c(arguments, 2000)[1])
  first <- as.integer(arguments[2])
  if (is.na(first)) first <- 1L
  failures <- summarise(run_all(seq(first, length.out = cases), script))
  quit(status = if (failures > 0) 1 else 0)
}

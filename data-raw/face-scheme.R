# Builds inst/extdata/face_scheme/*.csv, the tables that face_scheme() reads. Run at the project's
# root:
#
#   Rscript data-raw/face-scheme.R
#
# data-raw/face-scheme/ holds the published facial model (Vittert, Bowman and Katina 2019, and the
# authors' implementation) in its own terms: landmarks.csv, curves.csv, patches.csv, strips_left.csv
# (the strips of the left side); and choices.csv: where this package finds a curve in another way
# than the authors do, or might have, and why (spreads are across the curve, measured on 23
# simulated faces in dense correspondence); and definitions.csv, this package's own: landmarks by
# shape.

from <- "data-raw/face-scheme"
to <- "inst/extdata/face_scheme"
spec <- function(name) read.csv(file.path(from, name), na.strings = "", colClasses = "character")
write <- function(table, name) {
  write.csv(table, file.path(to, name), row.names = FALSE, na = "", quote = TRUE)
}

# Right for left: in the names of landmarks (exL), curves and patches (nose left) and the points at
# the lip's corner (LLL).
mirrored <- function(text) {
  text <- gsub("left", "RIGHT", gsub("right", "LEFT", text))
  text <- gsub("LEFT", "left", gsub("RIGHT", "right", text))
  text <- gsub("\\b(LL|UL|ML)L\\b", "\\1#", gsub("\\b(LL|UL|ML)R\\b", "\\1L", text))
  text <- gsub("#", "R", text)
  text <- gsub("^([a-z]+)L$", "\\1#", gsub("^([a-z]+)R$", "\\1L", text))
  gsub("#", "R", text)
}

constraints <- c("keep_away_from", "keep_away_to", "keep_away_radius", "keep_away_extension",
                 "keep_side_from", "keep_side_to", "keep_side_towards", "side_of", "side",
                 "trust_from", "trust_to", "angle_limit")

# The choices of both sides of the face: choices.csv speaks of the left one, and leaves out the side
# in the names of curves and paired landmarks.
choices_by_side <- function() {
  choices <- spec("choices.csv")
  landmarks <- spec("landmarks.csv")
  paired <- sub("L$", "", grep("L$", landmarks$landmark, value = TRUE))
  middle <- startsWith(choices$curve, "mid-line")
  left <- choices[!middle, ]
  ends <- grep("_(from|to|towards)$", grep("^keep", constraints, value = TRUE), value = TRUE)
  left[ends] <- lapply(left[ends], function(x) ifelse(x %in% paired, paste0(x, "L"), x))
  left$curve <- paste(left$curve, "left")
  left$side_of <- ifelse(is.na(left$side_of) | startsWith(left$side_of, "mid-line"), left$side_of,
                         paste(left$side_of, "left"))
  right <- left
  sided <- c("curve", ends, "side_of", "side")
  right[sided] <- lapply(left[sided], mirrored)
  rbind(left, right, choices[middle, ])
}

face_curves <- function() {
  curves <- spec("curves.csv")
  choice <- choices_by_side()
  stopifnot(choice$curve %in% curves$curve)
  at <- match(curves$curve, choice$curve)
  cut <- !is.na(curves$ear_cut)
  chosen <- function(column, authors) {
    ifelse(is.na(choice[[column]][at]), authors, choice[[column]][at])
  }
  data.frame(
    curves[c("curve", "from", "to")], kind = chosen("kind", curves$kind),
    radius = chosen("radius", curves$radius_mm), width = chosen("width", curves$half_width_mm),
    n = curves$n, cut_share = curves$ear_cut, cut_from = ifelse(cut, "enL", NA),
    cut_to = ifelse(cut, "enR", NA), choice[at, constraints], authors_kind = curves$kind,
    note = choice$note[at]
  )
}

# Patches whose first column lies along a curve: a published column is the same cut as the curve,
# and goes with it where it is no cut.
first_column <- function(patch) {
  side <- sub("^(philtrum|nose) ", "", patch)
  ifelse(startsWith(patch, "philtrum"), paste0("nasolabial ", side, "[1:6]"),
         ifelse(startsWith(patch, "nose"), paste0("nasal boundary ", side, "[20:1]"), NA))
}

winding <- c("c,r > c+1,r > c+1,r+1" = "columns", "c,r > c+1,r+1 > c+1,r" = "rows")

face_patches <- function() {
  patches <- spec("patches.csv")
  data.frame(
    patch = patches$patch, block = patches$sub, n = patches$n, columns = patches$columns_used,
    rows = patches$rows_made, rows_kept = patches$rows_kept, curve_a = patches$curve_a,
    resample_a = patches$resample_a, curve_b = patches$curve_b, resample_b = patches$resample_b,
    first_column = first_column(patches$patch), outward = winding[patches$outward],
    note = patches$left_out
  )
}

# Left strips whose outward order is a, b, next b; of the others it is a, next a, next b.
columns_first <- c("lower face top", "mid-face top", "cheek-eye", "nasal root", "mid-line nose",
                   "upper lip top", "mid-line mouth", "lips meet", "corner lower a",
                   "corner lower b", "under nose c")

face_strips <- function() {
  left <- spec("strips_left.csv")
  left$outward <- ifelse(left$strip %in% columns_first, "columns", "rows")
  right <- left
  right[c("a", "b")] <- lapply(left[c("a", "b")], mirrored)
  right$outward <- c(columns = "rows", rows = "columns")[left$outward]
  left$strip <- paste(left$strip, "left")
  right$strip <- paste(right$strip, "right")
  rbind(left, right)
}

face_pairs <- function(landmarks, curves, patches) {
  pairs <- function(level, name) {
    left <- unique(name[grepl("L$| left$", name)])
    data.frame(level = rep(level, length(left)), left = left, right = mirrored(left))
  }
  rbind(pairs("landmarks", landmarks$landmark), pairs("curves", curves$curve),
        pairs("surface", patches$patch))
}

# definitions.csv speaks of the left side and of the middle, too.
face_definitions <- function() {
  left <- spec("definitions.csv")
  right <- left[grepl("L$", left$landmark), ]
  names <- c("landmark", "from", "to", "across_from", "across_to")
  right[names] <- lapply(right[names], mirrored)
  rows <- rbind(left, right)
  rows[order(match(rows$landmark, landmarks$landmark)), ]
}

# Where the landmarks lie on the template of find_landmarks(), the mean of each with the mirror
# image of its partner: unit and names of a specimen's are held against them.
typical_places <- function(landmarks) {
  at <- read.csv(file.path("inst", "extdata", "face_template", "landmarks.csv"),
                 row.names = 1)[c("x", "y", "z")]
  own <- as.matrix(at[landmarks$landmark, ])
  other <- as.matrix(at[vapply(landmarks$landmark, mirrored, ""), ])
  round((own + other %*% diag(c(-1, 1, 1))) / 2, 1)
}

landmarks <- spec("landmarks.csv")[c("landmark", "name", "where")]
landmarks[c("x", "y", "z")] <- typical_places(landmarks)
dir.create(to, showWarnings = FALSE, recursive = TRUE)
write(landmarks, "landmarks.csv")
write(face_curves(), "curves.csv")
write(face_patches(), "patches.csv")
write(face_pairs(landmarks, face_curves(), face_patches()), "pairs.csv")
write(face_strips(), "strips.csv")
write(face_definitions(), "definitions.csv")

# Names of landmarks that a scheme does not know, and those of the scheme that may be meant.

#' What a specimen's landmarks have that a scheme does not use
#'
#' @param landmarks k x 3 matrix with row names, or the names.
#' @param scheme A scheme.
#' @return One string such as "not used: prn, CHL; near: pn, chL", NULL where all are used. The
#'   attribute `near` (character, the scheme's missing landmarks that may be meant, named by what is
#'   not used) is empty where there are none.
#' @noRd
unused_names <- function(landmarks, scheme, most = 8, letters = 1) {
  name <- if (is.character(landmarks)) landmarks else rownames(landmarks)
  known <- scheme$landmarks$landmark
  unused <- setdiff(name, known)
  if (!length(unused)) return(NULL)
  # For each name the missing landmark that it may stand for: the same but for case, blanks and
  # signs, the landmark's long name, or a letter or two more or fewer; the two sides of a pair are
  # never near
  missing <- scheme$landmarks[!known %in% name, , drop = FALSE]
  own <- plain_landmark(unused)
  short <- plain_landmark(missing$landmark)
  long <- plain_landmark(missing$name)
  near <- lapply(own, function(name) {
    same <- which(name == short | name == long)
    if (length(same)) return(same)
    distance <- as.vector(utils::adist(name, short))
    added <- abs(nchar(name) - nchar(short)) == distance
    mirrored <- grepl("l$", name) & grepl("r$", short) | grepl("r$", name) & grepl("l$", short)
    long_enough <- pmin(nchar(name), nchar(short)) > 1
    which(distance <= letters & (added | nchar(short) >= 5) & !mirrored & long_enough)
  })
  one <- lengths(near) == 1
  near <- stats::setNames(missing$landmark[unlist(near[one])], unused[one])
  text <- paste("not used:", shorten(unused, most))
  if (length(near)) text <- paste0(text, "; near: ", shorten(near, most))
  structure(text, near = near)
}

#' A warning where a landmark of the scheme is missing and one of another name may be meant
#' @param scheme A scheme, or a list with its `landmarks`.
#' @param of What it is called.
#' @noRd
warn_unused_names <- function(specimen, scheme, of) {
  unused <- unused_names(specimen$landmarks, scheme)
  near <- attr(unused, "near")
  if (!length(near)) return(invisible())
  crestline_warn(paste0("landmarks of ", of, " are missing, and others have names like them: ",
                        unused, "."),
                 paste0("If they are meant, rename them: ",
                        shorten(paste(names(near), "to", near)), "."),
                 stage = "landmarks", id = specimen$id, class = "crestline_unused_landmarks")
}

#' Names of landmarks as they are compared: small letters, no blanks nor signs, the side as a letter
#' at the end
#' @noRd
plain_landmark <- function(name) {
  name <- sub("^(left|right)[^[:alnum:]]+(.*)$", "\\2 \\1", tolower(name))
  name <- gsub("[^[:alnum:]]", "", name)
  sub("left$", "l", sub("right$", "r", name))
}

# Landmarks under each other's names: left for right, top for bottom, one for its neighbour.

#' What looks exchanged among some landmarks
#'
#' With a `reference` (typical positions of the landmarks, from the scheme) the names are compared
#' with it. Without one, the upward and the frontal direction give left and right of every pair; if
#' these are unknown, the other pairs do. The mid-line must not turn back. A landmark must lie near
#' the mirror image of its partner.
#'
#' @param at k x 3, row names, NA where missing.
#' @param front Unit vector to the front (mean of the surface's normals), or NULL.
#' @param pairs Data frame `left`, `right`: names.
#' @param midline Names along the mid-line from top to bottom, perhaps none.
#' @param reference k x 3 matrix with row names, NA where it is not known; NULL: none.
#' @param least Least cosine of the angle between a direction and the expected one at which the
#'   direction decides. On 45 faces the cosine between two landmarks and the same two of
#'   [face_scheme()] is never below 0.6; exchanged it is the same below 0.
#' @return List: `mirrored` (whether left and right of all pairs are exchanged), `groups` (list of
#'   the names that are exchanged among themselves), `either` (list of two such groups of which one
#'   is exchanged: symmetry cannot tell which).
#' @noRd
exchanged_landmarks <- function(at, front, pairs, midline, reference = NULL, least = 0.3) {
  at <- at[!is.na(at[, 1]), , drop = FALSE]
  pairs <- pairs[pairs$left %in% rownames(at) & pairs$right %in% rownames(at), ]
  midline <- intersect(midline, rownames(at))
  true <- stats::setNames(rownames(at), rownames(at))
  sides <- exchanged_sides(at, front, pairs, midline, least)
  true <- swapped(true, pairs$left[sides], pairs$right[sides])
  either <- list()
  known <- intersect(rownames(at), rownames(reference)[!is.na(reference[, 1])])
  if (length(known) >= 6) {
    true <- by_reference(true, at, reference[known, , drop = FALSE], pairs, least)
  } else {
    true <- along_midline(true, at, midline)
    found <- by_symmetry(true, at, pairs)
    true <- found$true
    either <- found$either
  }
  crossed <- true[pairs$left] == pairs$right & true[pairs$right] == pairs$left
  mirrored <- nrow(pairs) > 0 && all(crossed)
  if (mirrored) true[c(pairs$left, pairs$right)] <- c(pairs$left, pairs$right)
  # The groups of names that are exchanged among themselves
  groups <- list()
  open <- names(true)[true != names(true)]
  while (length(open)) {
    group <- open[1]
    while (!true[[group[length(group)]]] %in% group) group <- c(group, true[[group[length(group)]]])
    groups <- c(groups, list(sort(group)))
    open <- setdiff(open, group)
  }
  list(mirrored = mirrored, groups = groups, either = either)
}

#' Names of two landmarks, or of several pairs of them, exchanged
#' @param true For every name as given (names of the vector) what it should be.
#' @noRd
swapped <- function(true, a, b) {
  before <- true
  true[match(a, before)] <- b
  true[match(b, before)] <- a
  true
}

#' Landmarks as they should be named
#' @noRd
renamed <- function(at, true) {
  rownames(at) <- true[rownames(at)]
  at
}

#' Which pairs have left and right exchanged
#'
#' Left is up x front, where both are known and the pairs lie along it; else it is what most pairs
#' say.
#' @return Logical, a value a pair.
#' @noRd
exchanged_sides <- function(at, front, pairs, midline, least) {
  across <- at[pairs$left, , drop = FALSE] - at[pairs$right, , drop = FALSE]
  across <- across / row_lengths(across)
  if (!nrow(across) || anyNA(across)) return(rep(FALSE, nrow(pairs)))
  # The way from the bottom to the top of the mid-line, which two exchanged landmarks of several do
  # not turn round
  at <- at[midline, , drop = FALSE]
  up <- if (nrow(at) < 2) NULL else {
    axis <- svd(sweep(at, 2, colMeans(at)), nu = 0)$v[, 1]
    height <- drop(at %*% axis)
    sense <- sum(sign(outer(height, height, `-`))[upper.tri(diag(nrow(at)))])
    if (sense != 0) axis * sign(sense)
  }
  left <- if (is.null(up) || is.null(front)) NULL else {
    left <- drop(cross_rows(t(up), t(front)))
    if (sqrt(sum(left^2)) > least) unit_vector(left)
  }
  along <- if (!is.null(left)) drop(across %*% left)
  if (is.null(left) || stats::median(abs(along)) < 0.5) {
    along <- drop(across %*% eigen(crossprod(across), symmetric = TRUE)$vectors[, 1])
    most <- sign(sum(along > least) - sum(along < -least))
    if (nrow(across) < 3 || most == 0) return(rep(FALSE, nrow(pairs)))
    along <- along * most
  }
  along < -least
}

#' Names along the mid-line exchanged such that it does not run to and fro
#'
#' @param gain Least shortening of the way along it, in units of the distance of the two:
#'   exchanging two right ones makes it longer.
#' @noRd
along_midline <- function(true, at, midline, gain = 0.5) {
  if (length(midline) < 3) return(true)
  both <- utils::combn(midline, 2)
  for (round in seq_along(midline)) {
    named <- renamed(at, true)
    way <- function(order) sum(row_lengths(diff(named[order, , drop = FALSE])))
    shorter <- apply(both, 2, function(two) {
      order <- replace(midline, match(two, midline), rev(two))
      (way(midline) - way(order)) / sqrt(sum((named[two[1], ] - named[two[2], ])^2))
    })
    if (!isTRUE(max(shorter) > gain)) break
    two <- both[, which.max(shorter)]
    true <- swapped(true, two[1], two[2])
  }
  true
}

#' Names exchanged such that landmarks lie where the mirror images of their partners do
#'
#' @param gain Least lowering of the distances from the mirror images, in units of the distance of
#'   the two that are exchanged (at most 2).
#' @param left Greatest distance that is left, in the same unit.
#' @return List: `true`, `either`.
#' @noRd
by_symmetry <- function(true, at, pairs, gain = 1, left = 0.5) {
  either <- list()
  if (nrow(pairs) < 2) return(list(true = true, either = either))
  names <- rownames(at)
  pairs <- data.frame(level = "landmarks", pairs[c("left", "right")])
  partner <- match(partner_of(names, pairs, "landmarks"), names)
  both <- utils::combn(nrow(at), 2)
  both <- both[, partner[both[1, ]] != both[2, ], drop = FALSE]
  for (round in seq_len(nrow(pairs))) {
    named <- renamed(at, true)[names, ]
    # What exchanging two landmarks takes off the distances from the mirror images of partners
    across <- named[pairs$left, , drop = FALSE] - named[pairs$right, , drop = FALSE]
    normal <- main_direction(across / row_lengths(across))
    offset <- stats::median((named + named[partner, ]) %*% normal / 2)
    image <- named - 2 * outer(drop(named %*% normal) - offset, normal)
    apart <- function(i, a, b) {
      now <- function(i) ifelse(i == a, b, ifelse(i == b, a, i))
      row_lengths(named[now(partner[i]), , drop = FALSE] - image[now(i), , drop = FALSE])
    }
    a <- both[1, ]
    b <- both[2, ]
    rows <- list(a, b, partner[a], partner[b])
    before <- Reduce(`+`, lapply(rows, apart, 0, 0))
    after <- Reduce(`+`, lapply(rows, apart, a, b))
    distance <- row_lengths(named[a, , drop = FALSE] - named[b, , drop = FALSE])
    off <- data.frame(gain = (before - after) / (2 * distance), left = after / (4 * distance))
    fine <- which(off$gain > gain & off$left < left)
    if (!length(fine)) break
    two <- both[, fine[which.max(off$gain[fine])]]
    other <- partner[two]
    if (all(other != two)) {
      either <- c(either, list(list(sort(names[two]), sort(names[other]))))
      open <- !both[1, ] %in% c(two, other) & !both[2, ] %in% c(two, other)
      both <- both[, open, drop = FALSE]
    } else {
      true <- swapped(true, names[two[1]], names[two[2]])
    }
  }
  list(true = true, either = either)
}

#' Names exchanged such that the landmarks lie as those of the reference: sides first, where that
#' comes nearer to it
#' @noRd
by_reference <- function(true, at, reference, pairs, least) {
  names <- rownames(reference)
  both <- utils::combn(length(names), 2)
  laid <- function(true) robustly_laid(renamed(at, true)[names, ], reference)
  off <- function(true) sum(row_lengths(laid(true) - reference))
  turned <- swapped(true, pairs$left, pairs$right)
  if (off(turned) < off(true)) true <- turned
  for (round in seq_along(names)) {
    now <- laid(true)
    u <- now[both[1, ], , drop = FALSE] - now[both[2, ], , drop = FALSE]
    v <- reference[both[1, ], , drop = FALSE] - reference[both[2, ], , drop = FALSE]
    product <- row_products(u, v)
    wrong <- which(product < -least * row_lengths(u) * row_lengths(v))
    if (!length(wrong)) break
    two <- both[, wrong[which.min(product[wrong])]]
    true <- swapped(true, names[two[1]], names[two[2]])
  }
  true
}

#' Points laid onto others by the similarity that makes the sum of distances, not of their squares,
#' small
#'
#' @param rounds Times that weights are taken anew.
#' @param least Least distance, as a share of the size, that a weight is taken of.
#' @noRd
robustly_laid <- function(x, y, rounds = 10, least = 0.01) {
  weight <- rep(1, nrow(x))
  size <- sqrt(mean(rowSums(sweep(y, 2, colMeans(y))^2)))
  for (round in seq_len(rounds)) {
    centre <- colSums(x * weight) / sum(weight)
    aim <- colSums(y * weight) / sum(weight)
    from <- sweep(x, 2, centre)
    to <- sweep(y, 2, aim)
    turn <- nearest_rotation(from * weight, to)
    laid <- sweep(from %*% turn$rotation * sum(turn$d) / sum(weight * from^2), 2, aim, `+`)
    weight <- 1 / pmax(row_lengths(laid - y), least * size)
  }
  laid
}

word_list <- function(x) {
  if (length(x) < 2) return(x)
  paste(paste(x[-length(x)], collapse = ", "), "and", x[length(x)])
}

#' Groups of exchanged landmarks in words
#' @noRd
exchange_words <- function(found) {
  either <- function(two) paste(vapply(two, word_list, ""), collapse = " or else ")
  c(vapply(found$groups, word_list, ""), vapply(found$either, either, ""))
}

#' @noRd
warn_exchanged <- function(found, id) {
  if (found$mirrored) {
    crestline_warn(
      paste("left and right look mirrored: seen from the front, head up, the landmarks ending in L",
            "should be on the viewer's right (the subject's own left)."),
      paste("Swap the endings L and R of the names, or, if the scan itself is mirrored,",
            "change the sign of x of mesh and landmarks."),
      stage = "landmarks", id = id, class = "crestline_mirrored"
    )
  }
  groups <- exchange_words(found)
  if (!length(groups)) return(invisible())
  crestline_warn(
    sprintf("landmarks look exchanged: %s.", paste(groups, collapse = "; ")),
    paste0("Look at them (plot() with labels = TRUE) and exchange their names: what ends on them ",
           "is elsewhere."),
    stage = "landmarks", id = id, class = "crestline_exchanged"
  )
}

#' The mean of the surface's normals at some landmarks, NULL where there is none
#' @param located As of [surface_points()], a row a landmark.
#' @noRd
mean_front <- function(mesh, located) {
  face <- located$face[!is.na(located$face)]
  front <- rowSums(mesh$normals[1:3, mesh$it[, face], drop = FALSE])
  if (length(face) && sum(front^2) > 0) unit_vector(front)
}

#' Partners of names at one level; what is in no pair is its own
#' @noRd
partner_of <- function(name, pairs, level) {
  pairs <- pairs[pairs$level == level, ]
  partner <- c(pairs$right, pairs$left)[match(name, c(pairs$left, pairs$right))]
  ifelse(is.na(partner), name, partner)
}

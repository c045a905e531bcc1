# Names of specimens: matched between a sample and what the user gives by specimen, never by
# position.

#' Whether columns may hold names of specimens, by their own names: any of the usual words, in any
#' case, with or without id
#' @noRd
is_key_column <- function(name) {
  word <- paste0("(specimen|subject|individual|participant|patient|person|face|object|animal|",
                 "sample|scan|case|record|image|mesh|file|path|name|label|key)s?")
  bare <- tolower(gsub("^\ufeff|^\u00ef..|^X\\.U\\.FEFF\\.|[[:space:]._-]", "", name))
  grepl(paste0("^(ids?|", word, "|", word, "(ids?|names?|no|number|code)|",
               "ids?(no|number|code)|filepaths?)$"), bare)
}

#' Ids as they are compared: blanks, case, kind of slash and a file's extension aside
#' @noRd
plain_id <- function(id) {
  id <- gsub("\\", "/", gsub("^[\\h\\v]+|[\\h\\v]+$", "", id_text(id), perl = TRUE), fixed = TRUE)
  sub(id_extension(), "", tolower(id))
}

# Extensions of meshes, landmarks and pictures, so that a point in an id stays.
id_extension <- function() {
  paste0("([.](ply|obj|stl|mrk[.]json|json|csv|pts|tps|nts|dta|landmarkascii|fcsv|pp|ckpt|",
         "jpe?g|png|tiff?|bmp))+$")
}

#' Ids as text: whole numbers in all their digits, in every session; bytes that are no text of the
#' session are taken for Latin 1, as in files
#' @noRd
id_text <- function(id) {
  text <- if (is.numeric(id) && !is.factor(id)) sprintf("%.15g", id) else as.character(id)
  strange <- !validEnc(text)
  text[strange] <- iconv(text[strange], "latin1", "UTF-8")
  replace(text, is.na(id), NA)
}

#' The places of ids among names, by their plain form
#'
#' A folder counts only where both have one; a name may have more folders than the id. Ids that
#' differ by no more than their plain form hides are matched exactly.
#'
#' @return List of integer vectors, one an id; empty where the name is not there.
#' @noRd
id_places <- function(ids, names) {
  places <- function(id, name) {
    unname(split(seq_along(name), factor(name, unique(id)))[match(id, unique(id))])
  }
  again <- function(x) x %in% x[duplicated(x)]
  id <- plain_id(ids)
  name <- plain_id(names)
  bare_id <- sub("^.*/", "", id)
  bare_name <- sub("^.*/", "", name)
  found <- places(id, name)
  in_folder <- places(id, bare_name)
  without <- places(bare_id, ifelse(bare_name == name, name, NA))
  loose <- ifelse(bare_id == id, in_folder, without)
  empty <- lengths(found) == 0 & !again(bare_id)
  found[empty] <- loose[empty]
  deeper <- which(lengths(found) == 0 & bare_id != id & !is.na(id))
  found[deeper] <- lapply(id[deeper], function(one) which(endsWith(name, paste0("/", one))))
  found[again(id)] <- places(id_text(ids), id_text(names))[again(id)]
  found
}

#' Which value belongs to which specimen
#'
#' @param names Names of the values; NULL where they have none.
#' @param n Number of values.
#' @param ids Names of the specimens, numbers where they have none.
#' @param what What the values are called in messages: "`group`".
#' @param value "value" or "row".
#' @param same Function of several places: whether the values there are the same.
#' @param fail Function of problem and remedy that stops.
#' @return Integer: the place of each specimen's value.
#' @noRd
places_of_specimens <- function(names, n, ids, what, value, same, fail) {
  if (is.null(names)) {
    if (n != length(ids)) {
      fail(sprintf("%s has %d %ss for %d specimens.", what, n, value, length(ids)),
           "Give one for each.")
    }
    crestline_inform(paste0(
      what, " has no names of specimens: its ", value, "s are taken in the order of the specimens."
    ))
    return(seq_len(n))
  }
  place <- id_places(ids, names)
  absent <- ids[lengths(place) == 0]
  if (length(absent)) {
    fail(sprintf("%s has no %s for %s.", what, value, shorten(absent)),
         sprintf("The specimens are %s; it has %s. Name it alike, or leave the specimen out.",
                 shorten(ids), shorten(id_text(names))))
  }
  for (i in which(lengths(place) > 1)) {
    if (!same(place[[i]])) {
      fail(sprintf("%s has %d different %ss for %s.", what, length(place[[i]]), value, ids[i]),
           "Leave one of them.")
    }
  }
  vapply(place, `[`, 1L, 1L)
}

#' Whether specimens have names that were given: numbers in order stand for none
#' @noRd
has_ids <- function(ids) !identical(as.character(ids), as.character(seq_along(ids)))

#' Values by specimen, in the order of the specimens
#'
#' @param x Vector, named by specimen or, where it has no names, in their order; or a data frame
#'   with a column of specimens and one of values.
#' @param ids,fail As in [places_of_specimens()].
#' @param name Name of the argument.
#' @noRd
by_specimen <- function(x, ids, name, fail) {
  what <- sprintf("`%s`", name)
  if (is.data.frame(x)) {
    place <- rows_of_specimens(x, ids, name, fail)
    value <- setdiff(names(x), attr(place, "key"))
    if (length(value) != 1) {
      fail(sprintf("%s has the columns %s.", what, toString(names(x))),
           paste0("Give one column of values, and one of the specimens",
                  if (length(value) && nzchar(attr(place, "key"))) {
                    sprintf(": %s[c(\"%s\", \"%s\")]", name, attr(place, "key"), value[1])
                  }, "."))
    }
    return(x[[value]][place])
  }
  if (is.matrix(x) && ncol(x) == 1) x <- stats::setNames(as.vector(x), rownames(x))
  if (!is.atomic(x) || length(dim(x)) > 1) {
    fail(sprintf("%s is %s.", what, describe_value(x)),
         "Give a vector with a value for each specimen.")
  }
  same <- function(i) length(unique(as.vector(x[i]))) == 1
  unname(x[places_of_specimens(names(x), length(x), ids, what, "value", same, fail)])
}

#' The rows of a table in the order of the specimens
#'
#' @param data Data frame; its key is a column of one of the usual names, or row names, whichever
#'   holds all specimens.
#' @return Integer, with the attribute `key`: the column's name, "" for row names.
#' @noRd
rows_of_specimens <- function(data, ids, name, fail) {
  what <- sprintf("`%s`", name)
  keys <- table_keys(data)
  again <- names(data)[duplicated(names(data))]
  if (any(names(keys) %in% again)) {
    fail(sprintf("%s has two columns `%s`.", what, intersect(names(keys), again)[1]),
         "Leave one of them.")
  }
  known <- vapply(keys, function(key) mean(lengths(id_places(ids, key)) > 0), 0)
  distinct <- vapply(keys, function(key) !anyDuplicated(plain_id(key)), NA)
  keys <- keys[known > 0 | distinct][order(-known[known > 0 | distinct])]
  if (!length(keys) && has_ids(ids) && nrow(data) == length(ids)) {
    fail(sprintf("%s has no column of the specimens' names (%s).", what, shorten(ids)),
         sprintf("Its columns are %s. Give it a column `id`.", shorten(names(data))))
  }
  key <- c(names(keys), "")[1]
  column <- setdiff(names(data), key)
  same <- function(i) {
    # Whether some rows of a table are the same, in all of its columns, matrices and tables among
    # them
    row <- function(k) {
      cells <- lapply(data[column], function(x) as.list(if (length(dim(x)) == 2) x[k, ] else x[k]))
      unname(unlist(cells, recursive = FALSE))
    }
    all(vapply(i[-1], function(k) identical(row(k), row(i[1])), NA))
  }
  own <- if (length(keys)) keys[[1]]
  place <- places_of_specimens(own, nrow(data), ids, what, "row", same, fail)
  for (other in names(keys)[-1][known[names(keys)[-1]] == 1]) {
    if (any(vapply(id_places(ids, keys[[other]]), `[`, 1L, 1L) != place)) {
      fail(sprintf("the columns `%s` and `%s` of %s name different specimens.", key, other, what),
           "Leave one of them out.")
    }
  }
  structure(place, key = key)
}

#' What may be a table's key: columns by their names, and row names that were given
#' @return List of vectors by column; "row names" for these.
#' @noRd
table_keys <- function(data) {
  column <- names(data)[is_key_column(names(data))]
  keys <- lapply(stats::setNames(nm = column), function(name) data[[name]])
  keys <- Filter(is.atomic, keys)
  row <- attr(data, "row.names")
  if (is.character(row)) keys["row names"] <- list(row)
  keys
}

#' The first levels that differ by blanks or case only
#' @noRd
alike_levels <- function(levels) {
  plain <- tolower(gsub("[[:space:]]+", " ", trimws(levels)))
  levels[plain %in% plain[duplicated(plain)][1]]
}

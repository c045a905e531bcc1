# Which starts are tried, in which order.

test_that("a face without a side is right by caps and cups, where starts by the nose are not", {
  folder <- shared_data("simpop")
  table <- utils::read.csv(file.path(folder, "landmarks.csv"))
  table <- table[table$id == "simpop_09" & !table$landmark %in% ear_names, ]
  placed <- structure(as.matrix(table[c("x", "y", "z")]), dimnames = list(table$landmark, NULL))
  mesh <- suppressWarnings(read_specimen(file.path(folder, "simpop_09.ply")))$mesh
  across <- unit_vector(placed["exL", ] - placed["exR", ])
  side <- drop(across %*% (mesh$vb[1:3, ] - placed["pn", ]))
  mesh <- keep_vertices(mesh, side > -8)
  there <- c("pn", "sn", "n", "exL", "enL", "acL", "chL", "ls", "li", "gn")
  error <- function(sure) {
    found <- suppressWarnings(find_landmarks(mesh, settings = find_settings(sure = sure)))$placing
    at <- as.matrix(found[match(there, found$landmark), c("x", "y", "z")])
    mean(row_lengths(at - placed[there, ]))
  }
  expect_lt(error(find_settings()$sure), 3)
  expect_gt(error(find_settings()$agree[2]), 4)
})

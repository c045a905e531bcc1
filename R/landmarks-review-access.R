# Who may talk to the page of a review: the browser that R opened, and nobody else.

#' Run the page at an address with a random token, which page and socket ask for
#'
#' One session is served: a second would begin from the first state, and overwrite its records.
#'
#' @param ui,server As in [shiny::shinyApp()].
#' @param launch.browser,... As in [shiny::runApp()].
#' @param token Text; one that is given is of a page that comes after another at its address.
#' @return What the server ends with.
#' @noRd
run_review <- function(ui, server,
                       launch.browser = getOption("shiny.launch.browser", interactive()), ...,
                       token = NULL) {
  more <- if (is.null(token)) "" else "&app=1"
  if (is.null(token)) token <- random_token()
  # The server for who knows the token, from the page's own site; anybody else's session is closed
  taken <- FALSE
  app <- shiny::shinyApp(guarded_page(ui, token), function(input, output, session) {
    address <- shiny::isolate(session$clientData$url_search)
    if (!is_own_site(session$request) || !has_token(address, token)) return(session$close())
    if (taken) {
      message("The page is open already: another tab of its address was closed.")
      return(session$close())
    }
    taken <<- TRUE
    server(input, output, session)
  })
  shiny::runApp(app,
                launch.browser = function(url) open_page(
                  paste0(sub("/$", "", url), "/?token=", token, more), launch.browser
                ),
                ...)
}

open_page <- function(address, launch.browser) {
  if (is.function(launch.browser)) return(launch.browser(address))
  if (isTRUE(launch.browser)) return(utils::browseURL(address))
  message("Open ", address)
}

#' 128 bits of the system's random numbers, in hexadecimal
#' @noRd
random_token <- function() paste(cpp_random_bytes(16), collapse = "")

#' The page for who knows the token
#' @noRd
guarded_page <- function(ui, token) {
  function(request) {
    if (has_token(request$QUERY_STRING, token)) return(ui)
    shiny::httpResponse(403L, "text/plain",
                        "Open the address that R printed or opened: it has a token.")
  }
}

has_token <- function(query, token) {
  identical(shiny::parseQueryString(paste0("", query))[["token"]], token)
}

#' Whether a socket was asked for by a page of the same site
#'
#' Browsers name the site in the header Origin, which no script can change. A server that stands
#' between, such as RStudio's, says in a header of its own which address the browser knows.
#'
#' @param request Request that opened the socket: an environment of the form of Rook.
#' @noRd
is_own_site <- function(request) {
  host <- function(address) sub("^[a-z]+://([^/]*).*$", "\\1", tolower(address))
  origin <- request$HTTP_ORIGIN
  own <- c(request$HTTP_HOST, request$HTTP_X_FORWARDED_HOST, request$HTTP_X_RSTUDIO_REQUEST)
  is.character(origin) && grepl("^https?://", origin) && host(origin) %in% host(own)
}

#' @seealso The glossary in [crestline-package] explains the words of this page.

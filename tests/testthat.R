library(testthat)
library(crestline)

test_check("crestline")

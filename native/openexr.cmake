add_library(dp_openexr INTERFACE)

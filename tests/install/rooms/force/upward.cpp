// clang-format off
#include "core/error.h"
#include "force/own.h"
#include "study/study.h"
#  include "path/curve.h"
// #include "io/hdf5.h" is only a comment.
// Two of these includes are allowed.

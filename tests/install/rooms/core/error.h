// A room includes itself and nothing else.
#pragma once
#include <vector>

#include "core/other.h"

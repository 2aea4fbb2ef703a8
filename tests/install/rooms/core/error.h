// A room includes itself and nothing else.
#pragma once
#include "core/other.h"
#include <vector>

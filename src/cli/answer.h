#pragma once
#include "importance/point_answer.h"
#include "transport/ray_answer.h"

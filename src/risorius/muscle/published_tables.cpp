// SPDX-License-Identifier: MIT
#include "risorius/muscle/published_tables.h"

namespace risorius::muscle {

const PublishedTable& published_active_force() {
    static const PublishedTable table = {
        {0.52725, 0.226667}, {0.62875, 0.636667}, {0.71875, 0.856667}, {0.86125, 0.95},
        {1.045, 0.993333},   {1.2175, 0.77},      {1.43875, 0.246667}};
    return table;
}

const PublishedTable& published_passive_force() {
    static const PublishedTable table = {{1.0, 0},    {1.1, 0.035}, {1.2, 0.12}, {1.3, 0.26},
                                         {1.4, 0.55}, {1.5, 1.17},  {1.6, 2.0}};
    return table;
}

const PublishedTable& published_velocity_force() {
    static const PublishedTable table = {
        {-1.0, 0},        {-0.9, 0.021739}, {-0.8, 0.047619},  {-0.7, 0.078947}, {-0.6, 0.117647},
        {-0.5, 0.166667}, {-0.4, 0.230769}, {-0.3, 0.318182},  {-0.25, 0.375},   {-0.2, 0.444444},
        {-0.15, 0.53125}, {-0.1, 0.642857}, {-0.05, 0.791667}, {0.0, 1.0},       {0.05, 1.482014},
        {0.1, 1.601571},  {0.15, 1.655791}, {0.2, 1.686739},   {0.25, 1.706751}, {0.3, 1.720753},
        {0.4, 1.739055},  {0.5, 1.75049},   {0.6, 1.758312},   {0.7, 1.763999},  {0.8, 1.768321},
        {0.9, 1.771717},  {1.0, 1.774455}};
    return table;
}

}  // namespace risorius::muscle

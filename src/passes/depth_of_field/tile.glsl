const int kTile = 16;  // px, as in depth_of_field.cpp

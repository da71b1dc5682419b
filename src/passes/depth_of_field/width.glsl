// Which circles are narrow and which are wide, and how many of their pixels are read.

uniform int steps;  // from the middle of a circle to its rim, at most

// px from one pixel that is read to the next.
float strideOf(float radius) { return exp2(max(ceil(log2(max(radius, 1.0) / (float(steps) + 0.5))), 0.0)); }

// Narrow ones are read pixel by pixel.
bool isWide(float radius) { return radius > float(steps) + 0.5; }

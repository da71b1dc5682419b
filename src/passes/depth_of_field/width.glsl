// Which circles are narrow and which are wide, and how many of their pixels are read.

uniform int steps;  // from the middle of a circle to its rim, at most

// px from one pixel that is read to the next.
float strideOf(float radius) { return exp2(max(ceil(log2(max(radius, 1.0) / (float(steps) + 0.5))), 0.0)); }

// Narrow ones are read pixel by pixel.
bool isWide(float radius) { return radius > float(steps) + 0.5; }

// Whether, before the plane in focus, the first circle is so much larger that its thing is another one, in front
// of the second: 0 to 1.
const float kSame = 1.25, kOther = 1.75;
float inFront(float radius, float other) { return smoothstep(kSame, kOther, radius / max(other, 0.5)); }

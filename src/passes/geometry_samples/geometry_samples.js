// The mean of the normals of each pixel's samples, on the screen.
pipeline({name: "geometry_samples", output: "Shown.color"});

pass("Cull");
pass("GeometrySamples");
pass("Fullscreen", {name: "Shown", shader: "mean_normal.frag", format: "Rgba8Unorm", halo: 0});

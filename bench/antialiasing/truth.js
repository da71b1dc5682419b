// The deferred picture, each pixel the mean of sixteen, and a mask of the pixels that hold an edge of a surface:
// what anti-aliased pictures are measured against. Render at four times the size; SaveImage rows write both.
pipeline({name: "truth", output: "ToneMap.color"});

pass("Cull");
const g = pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
const toned = pass("ToneMap");
const mean = pass("Fullscreen", {name: "Mean", shader: "mean.frag", format: "Rgba8Unorm", outputScale: 0.25,
                                 reads: {color: toned.color}});
const edges = pass("Fullscreen", {name: "Edges", shader: "edges.frag", format: "Rgba8Unorm", outputScale: 0.25,
                                  reads: {depth: g.depth}});
pass("SaveImage", {name: "SaveTruth", file: "truth.png", reads: {color: mean.color}});
pass("SaveImage", {name: "SaveMask", file: "mask.png", reads: {color: edges.color}});

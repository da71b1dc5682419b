// The boxes of the culling hierarchy's leaves over the lit picture.
// For looking at what Cull works with.
pipeline({name: "bvh", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("ShowBvh");
pass("ToneMap");

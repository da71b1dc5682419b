// The deferred picture through a thin lens that is focused on one distance.
// DepthOfField's lensRadius and focusDistance are in metres: set them to the scene's scale.
pipeline({name: "depth_of_field", output: "ToneMap.color"});

pass("Cull");
pass("GBuffer");
pass("TileLights");
pass("TiledLighting");
pass("CustomShaders");
pass("Background");
pass("Mirrors");
pass("Transparency");
pass("DepthOfField", {lensRadius: 0.05, focusDistance: 5});
pass("ToneMap");

// The mask in colours: a hue for each layer; white where no light is blocked.
// For the figure of the page.
pipeline({name: "mask_colors", output: "Shown.color"});

pass("Cull");
pass("GBuffer");
pass("ShadowMaps");
pass("TileLights");
pass("ShadowLayers");
pass("ShadowMask");
pass("Fullscreen", {name: "Shown", shader: "mask_colors.frag", format: "Rgba8Unorm"});

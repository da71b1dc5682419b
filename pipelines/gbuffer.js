// One component of the G-buffer on the screen, as stored.
// `--set ShowGBuffer.component=normal` chooses which (`lucerna pass show ShowGBuffer` lists them).
pipeline({name: "gbuffer", output: "ShowGBuffer.color"});

pass("Cull");
pass("GBuffer");
pass("ShowGBuffer");

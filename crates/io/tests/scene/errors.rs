//! Mistakes within one text: each with its place and words.

use crate::report;

#[test]
fn names() {
    let said = report(&[
        "[camera]\n▸vfow = 30",
        "[material.wall.lambertian]\nalbedo = 0.5\n▸reflectance = 1",
        "▸cameras = 3",
        "[▸cam]",
        "[material.wall.▸lambertain]",
        "[material.wall]\n▸albedo = 0.5",
        "[environment.▸skye]",
        "[[shape.▸spheres]]\nradius = 1",
        "[render]\nintegrator = ▸\"weekand\"",
        "[render]\nintegrator = ▸\"bdpt\"",
        "[material.gold.metal]\n[[shape.sphere]]\nradius = 1\nmaterial = ▸\"glod\"",
        "[material.gold.metal]\n[[shape.sphere]]\nradius = 1\nmaterial = ▸\"velvet\"",
        "[[shape.sphere]]\nradius = 1\nmaterial = ▸\"velvet\"",
        "[material.ring.conductor]\nmetal = ▸\"glod\"",
        "[material.ring.conductor]\nmetal = ▸\"mithril\"",
        "[camera]\n▸\"red\\u001b[31m\\n`tick`, expected\" = 1",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn numbers() {
    let said = report(&[
        "[[shape.sphere]]\nradius = ▸nan",
        "[[shape.sphere]]\nradius = ▸inf",
        "[[shape.sphere]]\nradius = ▸-1",
        "[[shape.sphere]]\nradius = ▸0",
        "[[shape.sphere]]\nradius = 1\ncenter = ▸[0, nan, 0]",
        "[camera]\nvfov = ▸0",
        "[camera]\nvfov = ▸180",
        "[camera]\naperture = ▸-1",
        "[camera]\nfocus_distance = ▸0",
        "[material.m.metal]\nroughness = ▸1.01",
        "[material.m.metal]\nroughness = ▸-0.1",
        "[material.m.metal]\nroughness = ▸nan",
        "[material.m.lambertian]\nalbedo = ▸[0.5, 1.5, 0.5]",
        "[material.m.lambertian]\nalbedo = ▸-0.5",
        "[material.m.emissive]\nradiance = ▸-1",
        "[material.m.emissive]\nradiance = ▸[1, nan, 1]",
        "[environment.constant]\nradiance = ▸inf",
        "[environment.gradient]\ntop = ▸-1",
        "[material.m.dielectric]\neta = ▸0",
        "[material.m.dielectric]\neta = ▸nan",
        "[render]\nspp = ▸0\nwidth = ▸0\nheight = ▸99999999\nmax_depth = ▸2000000",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn types() {
    let said = report(&[
        "[camera]\nvfov = ▸\"wide\"",
        "[camera]\nlook_at = ▸[0, 0]",
        "[camera]\nlook_at = ▸[0, 0, 0, 0]",
        "[camera]\nlook_at = [0, ▸\"x\", 0]",
        "[camera]\nlook_at = ▸3",
        "[material.m.lambertian]\nalbedo = ▸[1, 1]",
        "[material.m.lambertian]\nalbedo = ▸[0, 0, 0, 0]",
        "[material.m.lambertian]\nalbedo = ▸\"red\"",
        "[material.m.lambertian]\nalbedo = ▸\"#12345\"",
        "[material.m.lambertian]\nalbedo = ▸true",
        "camera = ▸3\nshape = ▸4\nmaterial = ▸[1]\nrender = ▸2026-01-01",
        "[material]\nwall = ▸3",
        "[material.wall]\nmetal = ▸3",
        "environment = ▸\"none\"",
        "▸[environment]",
        "[material.one.metal]\n▸[material.none]",
        "include = ▸\"a.toml\"",
        "▸[shape.sphere]\nradius = 1",
        "[render]\nspp = ▸1.5\nseed = ▸-1\nwidth = ▸1e400\nheight = ▸99999999999999999999",
        "[[shape.mesh]]\nvertices = [[0, 0, 0], ▸[0, 0]]\ntriangles = [[0, 0, ▸-1]]",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn things_that_do_not_go_together() {
    let said = report(&[
        "[camera]\nlook_from = [1, 2, 3]\nlook_at = ▸[1, 2, 3]",
        "[camera]\nlook_from = [0, 5, 0]\nlook_at = [0, 0, 0]\nup = ▸[0, -2, 0]",
        "[camera]\nup = ▸[0, 0, 0]",
        "[camera]\naperture = 0.1\ndefocus_angle = ▸1",
        "[material.▸wall.metal]\n[material.wall.lambertian]",
        "[[shape.quad]]\ncorner = [0, 0, 0]\nu = [1, 0, 0]\nv = ▸[-2, 0, 0]",
        "[[shape.quad]]\ncorner = [0, 0, 0]\nu = ▸[0, 0, 0]\nv = [-2, 0, 0]",
        "[[shape.mesh]]\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ntriangles = [[0, 1, 2], ▸[1, 2, 3]]",
        "[[shape.mesh]]\nvertices = [▸[0, inf, 0]]\ntriangles = []",
        "[[shape.sphere]]\nradius = 1\n▸[[shape.sphere]]\ncenter = [0, 0, 0]",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn motion() {
    let ball = |rest: &str| format!("[[shape.sphere]]\nradius = 1\n{rest}");
    let turns = "{ axis = [0, 1, 0], angle = ";
    let shapes = [
        "motion = [{ time = 1 }, { time = ▸0 }]",
        "motion = [{ time = 0 }, { time = 1 }, { time = ▸1 }]",
        "motion = [{ time = ▸nan }]",
        "motion = [{ time = 0, offset = ▸[0, inf, 0] }]",
        "motion = [{ time = 0, scale = ▸0 }]",
        "motion = [{ time = 0, scale = ▸-1 }]",
        "motion = [{ time = 0, rotation = { axis = ▸[0, 0, 0], angle = 3 } }]",
        "motion = [{ time = 0, rotation = { axis = [0, 0, 1], angle = ▸1e7 } }]",
        "motion = [{ time = 0, rotation = ▸{ axis = [0, 0, 1], ▸angel = 3 } }]",
        "motion = [▸{ offset = [0, 0, 0] }]",
        "motion = ▸{ time = 0 }",
        "pivot = ▸[0, 0, 0]",
        "pivot = ▸[0, nan, 0]\nmotion = [{ time = 0 }]",
        &format!("motion = ▸[{{ time = 0, rotation = {turns}0 }} }}, {{ time = 1, rotation = {turns}1e6 }} }}]"),
    ]
    .map(ball);
    let others = [
        "[render]\nshutter = ▸[1, 0.5]",
        "[render]\nshutter = ▸[-1, 0.5]",
        "[render]\nshutter = ▸[0, nan]",
        "[render]\nshutter = ▸0.5",
        "[[camera.motion]]\ntime = 1\n[[camera.motion]]\ntime = ▸0.5",
        "[[camera.motion]]\ntime = 1\nlook_from = ▸[0, nan, 0]",
        "[camera]\nlook_at = [1, 2, 3]\n▸[[camera.motion]]\ntime = 1\nlook_from = [1, 2, 3]",
        "[[camera.motion]]\ntime = 0\nup = ▸[0, 0, 0]",
        "[[camera.motion]]\ntime = 0\n[[camera.motion]]\ntime = ▸1\nlook_at = [0, 2, 12]",
    ];
    let all: Vec<_> = shapes.iter().map(String::as_str).chain(others).collect();
    insta::assert_snapshot!(report(&all));
}

#[test]
fn materials_of_others() {
    let said = report(&[
        "▸[material.a.mix]\na = \"b\"\nb = \"default\"\n▸[material.b.bump]\nof = \"a\"\nheight = 1",
        "▸[material.a.mask]\nof = \"a\"\nopacity = 0.5",
        "[material.a.mix]\na = \"default\"\nb = ▸\"nothing\"\nshare = ▸2",
        "[material.a.mask]\nof = \"default\"\nopacity = ▸\"leaf\"",
        "▸[material.a.mask]\nopacity = 1",
        "[material.a.normal-map]\nof = \"default\"\nmap = ▸\"waves\"\nstrength = ▸nan",
        "[material.a.bump]\nof = \"default\"\nheight = ▸1e9\nscale = ▸inf",
        "[material.a.null]\n▸opacity = 0",
        "[material.m.metal]\nroughness = ▸\"scratches\"",
        "[material.m.emissive]\nradiance = ▸\"screen\"",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn fillings() {
    let said = report(&[
        "[material.m.dielectric]\nabsorption = ▸[1, -1, 1]",
        "[material.m.dielectric]\nabsorption = ▸nan",
        "[material.m.dielectric]\ntransmittance = ▸1.5",
        "[material.m.dielectric]\ntransmittance = ▸0.5\nabsorption = 1",
        "[material.m.dielectric]\ntransmittance = 0.5\ntransmittance_distance = ▸0",
        "[material.m.dielectric]\npriority = ▸1001\neta = ▸-1.5",
        "[material.m.dielectric]\npriority = ▸-1",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn syntax() {
    let said = report(&[
        "[camera]\nvfov = ▸",
        "[camera▸\nvfov = 30",
        "[camera]\nvfov = 30\n▸vfov = 40",
        "[camera]\n[▸camera]",
        "[camera]\nvfov = ▸30 40",
        "include = [\"a▸\n]",
    ]);
    insta::assert_snapshot!(said);
}

#[test]
fn all_at_once_and_in_order() {
    let said = report(&["
[[shape.sphere]]
radius = ▸\"big\"
▸[[shape.sphere]]
[[shape.sphere]]
radius = ▸-1
material = ▸\"wal\"
[material.gold.▸metl]
[material.wall.metal]
roughness = ▸2
▸roughnes = 2
[[shape.sphere]]
radius = 1
material = \"gold\"
[[shape.quad]]
corner = ▸[0, 0]
u = [1, 0, 0]
v = [1, 0, 0]
[camera]
vfov = ▸200
[▸foo]
"]);
    insta::assert_snapshot!(said);
}

#[test]
fn mistakes_do_not_hide_those_of_the_next_in_a_list() {
    report(&[
        "[[shape.sphere]]\nradius = ▸\"a\"\n▸[[shape.sphere]]\n▸[[shape.sphere]]\n[[shape.sphere]]\nradius = ▸true\n▸x = 1",
        "[material]\na = ▸1\n[[shape.sphere]]\nradius = ▸true\nmaterial = ▸3\n▸[[shape.sphere]]\nmaterial = \"a\"",
    ]);
}

#[test]
fn columns_count_characters() {
    report(&[
        "[camera]\r\n# Größe\r\n\r\n▸vfow = 3\r\nvfov = ▸0\r\n",
        "▸\"é𝄞\" = {}",
        "[[shape.sphere]]\nradius = 1\nmaterial = ▸\"é\"",
        "[material.\"é日本𝄞\".▸matte]",
        "[material.\"é日本𝄞\"]\nlambertian = { albedo = 0.5, ▸ä = 1 }",
        "\t▸x = 1",
    ]);
}

#[test]
fn a_long_list_ends() {
    let text = "[[shape.sphere]]\n".repeat(100_000);
    let found = crate::problems(eyebeam_io::scene::read_str("a.toml", &text, &[]).unwrap_err());
    assert_eq!(found.len(), 21);
    assert_eq!(crate::places(&found)[19], (20, 1));
    assert_eq!(found[20].message, "these are the first 20 mistakes; there may be more");
}

#[test]
fn names_are_cut_where_nobody_reads_on() {
    let text = format!("{} = 1", "x".repeat(1 << 20));
    let error = eyebeam_io::scene::read_str("a.toml", &text, &[]).unwrap_err();
    assert!(error.to_string().len() < 2000);
}

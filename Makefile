# The few commands that a person needs.

EMBREE_VERSION = 4.4.0.post1

.PHONY: test bench bench-kernel figures pictures schema

# Everything that can be checked: format, lints, tests, examples in the documentation, and that it builds.
test:
	@rustup component add rustfmt clippy 2>/dev/null || true
	cargo fmt --all --check
	cargo clippy --workspace --all-targets --locked -- -D warnings
	cargo test --workspace --locked
	RUSTDOCFLAGS="-D warnings" cargo doc --workspace --no-deps --locked

# Speed, and the comparison with a textbook program (docs/performance.md).
bench:
	cargo bench -p eyebeam-bench

# The ray kernel against Embree, which is unpacked to target/embree if it can be had; otherwise its columns stay empty.
bench-kernel:
	@ls target/embree/embreex*/libembree4*.so* >/dev/null 2>&1 || { \
		mkdir -p target/embree \
		&& python3 -m pip download --quiet --no-deps embreex==$(EMBREE_VERSION) -d target/embree \
		&& python3 -m zipfile -e target/embree/embreex-$(EMBREE_VERSION)-*.whl target/embree; \
	} || echo "Embree could not be fetched: going on without it" >&2
	cargo run --release --locked -p eyebeam-bench -- kernel $(ARGS)

# The study: pictures and numbers (docs/figures).
figures:
	cargo run --release -- figures paper -o docs/figures

# The pictures in the README.
pictures:
	mkdir -p docs/pictures
	cargo run --release -- render scenes/spheres.toml -o docs/pictures/spheres.png --spp 1024
	cargo run --release -- render scenes/weekend.toml -o docs/pictures/weekend.png --spp 512 -r 800x450
	cargo run --release -- render scenes/cornell.toml -o docs/pictures/cornell.png --spp 2048
	cargo run --release -- render scenes/roughness.toml -o docs/pictures/roughness.png --spp 512 -r 800x300
	cargo run --release -- render scenes/two-spheres.toml -o docs/pictures/two-spheres.png --spp 1024

# The schema that editors use; a test checks that it is up to date.
schema:
	cargo run --release -- schema > docs/formats/scene.schema.json

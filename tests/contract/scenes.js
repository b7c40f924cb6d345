// scenes.js - random scenes: scene files with keys changed by the schema. Seeded, so that a run can be repeated.
'use strict';

/* Returns a generator of numbers from 0 to 1 (mulberry32). */
function randomOf(seed) {
    let a = seed >>> 0;
    return () => {
        a = (a + 0x6d2b79f5) >>> 0;
        let t = Math.imul(a ^ (a >>> 15), a | 1);
        t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

class Scenes {
    constructor(schema, files, seed) {
        this.schema = schema;
        this.files = files;
        this.random = randomOf(seed);
    }

    below(count) { return Math.floor(this.random() * count); }
    pick(list) { return list[this.below(list.length)]; }
    chance(share) { return this.random() < share; }

    find(reference) {
        let at = this.schema;
        for (const key of reference.slice(2).split('/')) at = at[key];
        return at;
    }

    /* Follows references; members beside one are added. */
    resolve(schema) {
        while (schema && schema.$ref) {
            const { $ref, ...beside } = schema;
            schema = { ...this.find($ref), ...beside };
        }
        return schema;
    }

    number(schema) {
        const low = schema.exclusiveMinimum ?? schema.minimum ?? -1e6, high = schema.exclusiveMaximum ?? schema.maximum ?? 1e6;
        const small = [0, 1, -1, 0.5, 2, 3, 45].filter((v) => v > low && v < high);
        const kind = this.random();
        if (kind < 0.6 && small.length) return this.pick(small);
        if (kind < 0.75 && schema.exclusiveMinimum === undefined) return low;
        if (kind < 0.85 && schema.exclusiveMaximum === undefined) return high;
        return Number((Math.max(low, -100) + this.random() * (Math.min(high, 100) - Math.max(low, -100))).toPrecision(4));
    }

    string(schema) {
        const pattern = schema.pattern ?? '';
        if (pattern.includes('#')) return '#' + this.pick(['fff', 'a0b1c2', '123456ff', 'f00f']);
        if (pattern.startsWith('^data:')) return 'data:application/octet-stream;base64,' + this.pick(['', 'AAAA', 'bm8=']);
        if (pattern.includes('[A-Z]')) return 'Tomato';
        if (pattern.includes('{1,64}')) return this.pick(['a', 'view_1', 'side-2']);
        return this.pick(['a', 'red', 'part', '1', 'x y']);
    }

    /* Returns a value for a schema, without regard to rules about several keys. */
    value(given, depth = 0) {
        const schema = this.resolve(given);
        if (schema === false) return null;
        if ('const' in schema) return schema.const;
        if (schema.enum) return this.pick(schema.enum);
        const any = schema.anyOf ?? schema.oneOf;
        if (any && !schema.type) return this.value(this.pick(any), depth);
        switch (schema.type) {
        case 'number': return this.number(schema);
        case 'integer': return Math.round(Math.min(Math.max(this.number(schema), schema.minimum ?? 0), schema.maximum ?? 1e6));
        case 'boolean': return this.chance(0.5);
        case 'null': return null;
        case 'string': return this.string(schema);
        case 'array': return this.list(schema, depth);
        case 'object': return this.object(schema, depth);
        default: throw new Error(`no value for ${JSON.stringify(schema).slice(0, 200)}`);
        }
    }

    list(schema, depth) {
        if (schema.prefixItems) return schema.prefixItems.map((item) => this.value(item, depth + 1));
        const least = schema.minItems ?? 0, most = Math.min(schema.maxItems ?? 99, least + (depth < 4 ? 3 : 1));
        return Array.from({ length: least + this.below(most - least + 1) }, () => this.value(schema.items, depth + 1));
    }

    object(schema, depth) {
        const made = {};
        for (const key of Object.keys(schema.properties ?? {}))
            if ((schema.required ?? []).includes(key) || this.chance(depth < 2 ? 0.25 : 0.15)) made[key] = this.value(schema.properties[key], depth + 1);
        if (typeof schema.additionalProperties === 'object') made[this.pick(['a', 'b'])] = this.value(schema.additionalProperties, depth + 1);
        return made;
    }

    /* Returns the closed objects that a value may be. */
    objects(given, value) {
        const schema = this.resolve(given);
        if (!schema || typeof schema !== 'object') return [];
        if (schema.properties) return [schema];
        return (schema.anyOf ?? schema.oneOf ?? []).flatMap((branch) => this.objects(branch, value));
    }

    itemsOf(given) {
        const schema = this.resolve(given);
        if (!schema || typeof schema !== 'object') return [];
        if (schema.items && typeof schema.items === 'object') return [schema.items];
        return (schema.anyOf ?? []).flatMap((branch) => this.itemsOf(branch));
    }

    /* Collects the objects of a scene with their schemas: [{value, schema}]. Lists of numbers are passed over. */
    places(value, schema, found = []) {
        if (Array.isArray(value)) {
            for (const items of this.itemsOf(schema))
                for (const item of value.slice(0, 50)) if (item && typeof item === 'object' && !Array.isArray(item)) this.places(item, items, found);
        } else if (value && typeof value === 'object') {
            const fits = this.objects(schema, value);
            const best = fits.find((one) => Object.entries(one.properties).every(([key, of]) => !of || !('const' in of) || value[key] === undefined || of.const === value[key])
                && Object.keys(value).every((key) => key in one.properties)) ?? fits[0];
            if (!best) return found;
            found.push({ value, schema: best });
            for (const key of Object.keys(value)) if (best.properties[key]) this.places(value[key], best.properties[key], found);
        }
        return found;
    }

    wrong() {
        return this.pick([null, true, false, 0, -1, 1.5, 2, 7, 1e7, -1e9, 1e18, 1e39, '', 'a', 'red', '#12', 'front', 'PNG', [], {}, [1], [0, 0, 0], [1, 2, 3, 4, 5], ['a'], [[1]], { a: 1 }]);
    }

    /* Changes one place of a scene: by the schema, or against it. */
    change(scene, isBroken) {
        const { value, schema } = this.pick(this.places(scene, this.schema));
        const keys = Object.keys(value), known = Object.keys(schema.properties), kind = this.random();
        if (!isBroken) {
            const key = this.pick(kind < 0.5 && keys.length ? keys.filter((k) => k in schema.properties) : known) ?? this.pick(known);
            if (!/^(meshes|polygons|positions|faces)$/.test(key)) value[key] = this.value(schema.properties[key], 1);
            return;
        }
        const key = this.pick(keys.length ? keys : known);
        if (kind < 0.4) value[key] = this.wrong();
        else if (kind < 0.55) value[this.pick(known)] = this.wrong();
        else if (kind < 0.7) delete value[key];
        else if (kind < 0.8) value[key + this.pick(['s', 'x', '_'])] = value[key];
        else if (Array.isArray(value[key])) this.breakList(value[key]);
        else if (typeof value[key] === 'number') value[key] = value[key] * this.pick([-1, 1000, 1e9, 0]);
        else if (typeof value[key] === 'string') value[key] = value[key] + 'x';
        else value[this.pick(known)] = this.value(schema.properties[this.pick(known)], 1);
    }

    breakList(list) {
        const at = this.below(list.length);
        if (this.chance(0.3)) list.pop();
        else if (this.chance(0.3)) list.push(this.wrong());
        else if (Array.isArray(list[at]) && this.chance(0.5)) this.breakList(list[at]);
        else list[at] = this.wrong();
    }

    /* Returns a scene; `isBroken`: with changes against the schema. */
    next(isBroken) {
        const scene = JSON.parse(this.pick(this.files));
        scene.window = { width: 32, height: 24 };
        const changes = 1 + this.below(3);
        for (let i = 0; i < changes; i++) this.change(scene, isBroken && i === 0);
        const side = (value) => (Number.isInteger(value) && value > 64 && value <= 8192 ? 64 : value);
        if (scene.window && typeof scene.window === 'object')
            for (const key of ['width', 'height']) if (key in scene.window) scene.window[key] = side(scene.window[key]);
        if (scene.window && scene.window.width === undefined && typeof scene.window === 'object') scene.window.width = 32;
        return JSON.parse(JSON.stringify(scene));
    }
}

module.exports = { Scenes };

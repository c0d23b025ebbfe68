(()=>{var{make:y}=document.currentScript.shared;var{CanvasPen:J}=document.currentScript.shared;var{HALO_WIDTH:Z,HATCH_PITCH:Q,HATCH_WIDTH:ee,SERIF:I,STYLES:F,colours:T}=document.currentScript.shared;var{writeNumber:z}=document.currentScript.shared;var{LIGHT:te,Pen:ne,cornersOf:se,textParts:ae,traceDisc:oe}=document.currentScript.shared;var{counted:k}=document.currentScript.shared;var{along:ie}=document.currentScript.shared;var{tableLonlat:re}=document.currentScript.shared;var{lonLatOf:A}=document.currentScript.shared;var{asCount:C}=document.currentScript.shared;var{Kept:W,filled:G,run:le}=document.currentScript.shared;var ze=3,Ce=3,je=class extends ne{#t=[];#e=[];text(e){let[n,t]=[f(this.width),f(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${V(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${v("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${I}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}draw(e,n,t,s=F[e]){let a=ce(n);if(a==="")return;let o=[];s.hatch!==void 0&&o.push(`fill="url(#${this.#o(s.hatch)})"`),s.fill!==void 0&&o.push(v("fill",t??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&o.push(this.#n(s,t)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:n,corner:t},s){let a=`clip-${this.#t.length}`;n&&this.#t.push(`<clipPath id="${a}"><path d="${ce(n)}"/></clipPath>`);let o=n?` clip-path="url(#${a})"`:"",l=e<1?` opacity="${e}"`:"",i=t?` transform="translate(${t.map(f).join(" ")})"`:"";this.#e.push(`<g${o}${l}${i}>`),s(),this.#e.push("</g>")}discs(e,n,t){let{radius:s,fill:a,rim:o,rimWidth:l,opacity:i}=n,r=f(s-l/2),c=`dots-${this.#t.length}`,d=[];for(let p=0;p<t.length;p+=2)d.push(`<circle cx="${f(t[p])}" cy="${f(t[p+1])}" r="${r}"/>`);this.#t.push(`<g id="${c}">${d.join("")}</g>`);let h=`fill="none" ${v("stroke",this.colours[o],i)} stroke-width="${f(2*l)}"`;this.#e.push(`<use class="${e}-rim" href="#${c}" ${h}/>`),this.#e.push(`<use class="${e}" href="#${c}" ${v("fill",this.colours[a],i)}/>`)}spots(e,n){let t=this.#n(F["spot-line"]);n.forEach((s,a)=>{let[o,l,i]=[e[3*a],e[3*a+1],e[3*a+2]].map(f);this.#e.push(`<circle class="spot" cx="${o}" cy="${l}" r="${i}" ${v("fill",s)} ${t}/>`)})}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ae(e,s.italic??!1).map(r=>r.italic?`<tspan font-style="italic">${V(r.text)}</tspan>`:V(r.text)).join(""),l=`paint-order="stroke" ${v("stroke",this.inkOf(s.halo))} stroke-width="${Z}"`,i=`x="${f(n)}" y="${f(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${i} ${v("fill",this.inkOf(s.ink))} ${l}>${o}</text>`)}picture(e,n,t,s,a){if(e instanceof HTMLImageElement){let i=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[n,t]},()=>this.#e.push(i))}let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let l=`x="${f(n)}" y="${f(t)}" width="${f(s)}" height="${f(a)}"`;this.#e.push(`<image ${l} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`,s=f((e.width??1)*this.weight);return`${v("stroke",n,e.strokeOpacity)} stroke-width="${s}"${t}`}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?v("fill",s):`fill="url(#${this.#a(s)})"`;this.#e.push(`<circle ${a} cx="${f(e)}" cy="${f(n)}" r="${f(t)}"/>`)}#a({id:e,stops:n}){let t=n.map(([a,o])=>`<stop offset="${a}" ${v("stop-color",o,1,"stop-opacity")}/>`),s=Object.entries(te).map(([a,o])=>`${a}="${f((o+(a==="r"?0:1))/2)}"`);return this.#s(e,`<radialGradient id="${e}" ${s.join(" ")}>${t.join("")}</radialGradient>`)}#o(e){let[n,t]=[`hatch-${e}`,Q],s=`M0 ${t/2}H${t}${e==="crossed"?`M${t/2} 0V${t}`:""}`,a=`${v("stroke",this.colours.hatch)} stroke-width="${ee}"`,o=`width="${t}" height="${t}" patternUnits="userSpaceOnUse" patternTransform="rotate(-45)"`;return this.#s(n,`<pattern id="${n}" ${o}><path ${a} d="${s}"/></pattern>`)}#s(e,n){return this.#t.includes(n)||this.#t.push(n),e}};function ce(e){let n="";return e({moveTo:(t,s)=>n+=`M${f(t)} ${f(s)}`,lineTo:(t,s)=>n+=`L${f(t)} ${f(s)}`,ellipse(t,s,a,o,l,i,r,c=!1){let[d,h]=[Math.cos(l),Math.sin(l)],p=b=>{let[u,g]=[a*Math.cos(b),o*Math.sin(b)];return[t+u*d-g*h,s+u*h+g*d]};n===""?this.moveTo(...p(i)):this.lineTo(...p(i));let m=Math.ceil(Math.abs(r-i)/Ce),$=`${f(a)} ${f(o)} ${f(l*180/Math.PI)} 0 ${c?0:1}`;for(let b=1;b<=m;++b){let[u,g]=p(i+(r-i)*b/m);n+=`A${$} ${f(u)} ${f(g)}`}},closePath:()=>n+="Z"}),n}function f(e){return z(e,ze)}function v(e,n,t=1,s=`${e}-opacity`){let[a,o,l,i=1]=(n.match(/[\d.]+/g)??[]).map(Number),r=i*t,c=r===1?"":` ${s}="${f(r)}"`;return`${e}="rgb(${a}, ${o}, ${l})"${c}`}function V(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var x={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},N=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,He=new Set(x.missing),P=e=>He.has(e.trim().toLowerCase()),Ue=new RegExp(`\\0|[^\\x00-\\x7f${x.western}]|[^\\x00-\\x7f]{3}`),Fe="぀";function B(e,n=!1){let[t,s]=["lon","lat"].map(a=>{let[o,l]=[x[a],x[`unsure_${a}`]],c=[d=>o.includes(d),(d,h)=>o.some(p=>h.includes(p)||p>Fe&&d.includes(p)),(d,h)=>h.length>0&&h.every(p=>l.includes(p))].slice(0,n?2:3).map(d=>e.filter(h=>d(h.trim().toLowerCase(),We(h)))).find(d=>d.length>0);return c?.length===1?c[0]:null});return t===null||s===null||t===s?null:[t,s]}function We(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(t=>t!==""&&!x.beside.includes(t))}var Ge=new RegExp(`^(?:${x.lettered})$`,"iu"),Ve=new RegExp(`[${x.printed}${x.unseen}]`,"gu");function j(e){return e.replace(Ve,t=>x.typed[x.printed.indexOf(t)]??"").trim().replace(/\s+/g," ")}var Be=new Map(Object.entries({...x.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),we=e=>Be.get(e.length>1?e.toLowerCase():e),de="[0-9]+(?:[.,][0-9]*)?",qe=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${de})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${de})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function Ye(e){let n=e.length>200?null:qe.exec(j(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(h=>h!==void 0),l=o.map(h=>h.replace(",",".").replace(/\.$/,"")),i=t??s?we(t??s):"",r=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h));return i===void 0||t&&s||i&&a||!r||l.slice(1).some(h=>Number(h)>=60)?null:{degrees:(i==="W"||i==="S"||a==="-"?-1:1)*(i==="O"?NaN:Xe(l)),point:i}}function Xe(e){if(e.length===1)return Number(e[0]);let n=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((t,s)=>60*t+Math.round(Number(s)*n),0)/(n*60**(e.length-1))}var ye=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Ke=/^[-+]?0[0-9]/;function Je(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function Ze(e,n,t){let[s,a]=[he(e,n,"longitude"),he(e,t,"latitude")];return $e(xe(s,a),e.wrong)}function $e(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=[e[2*t],e[2*t+1]];n.has(t)||(Math.abs(a)>90?n.set(t,`latitude ${a} is outside [-90, 90]; is it the longitude, or not in degrees?`):Math.abs(s)>360&&n.set(t,`longitude ${s} is outside [-360, 360]`))}return e}function Qe(e,n,t){let s=_e(e.columns),a=[n,t].map(o=>Re(e,o,e.columns.get(o),l=>Se(l,s)?"may have a decimal mark or thousands; write thousands without one":Ee(l)));return xe(a[0],a[1])}function et(e,n){let t=_e(e),s=i=>N.test(i)&&!Ke.test(i)&&!Se(i,t),a=i=>P(i)||s(i.trim()),o=[...e].filter(([i,r])=>!n.has(i)&&r.every(a)&&!r.every(P)),l=i=>P(i)?NaN:ke(i.trim());return new Map(o.map(([i,r])=>[i,Float64Array.from(r,l)]))}function _e(e){let t=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>N.test(s)&&!ye.test(s));return[...new Set(t.map(ve))].join("")||"."}var ve=e=>e.includes(",")?",":".",Se=(e,n)=>ye.test(e)&&ve(e)!==n;function xe(e,n){return Float64Array.from({length:2*e.length},(t,s)=>(s%2===0?e:n)[s>>1])}var ke=e=>Number(e.replace(",","."));function he(e,n,t){return Re(e,t,tt(e,n,t),s=>{let a=N.test(s)?null:Ye(s);if(a===null)return Ee(s);let o=a.point===""?t:/[NS]/.test(a.point)?"latitude":"longitude";return o!==t?`is a ${o}`:a.point==="O"?"has an O, which is east in German and west in French; write E or W in its place":a.degrees})}function tt({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!Ge.test(o))return s;let l=e.get(o).map(c=>P(j(c))?"":j(c)),i=l.filter(Boolean).map(c=>we(c)??"?");return!(i.length>0&&i.every(c=>(t==="latitude"?"NS":"EWO").includes(c)))||s.some(c=>j(c).includes("-")&&!P(c))?s:s.map((c,d)=>P(c)?"":`${c} ${l[d]}`.trim())}var Ee=e=>N.test(e)?ke(e):NaN;function Re({wrong:e},n,t,s){return Float64Array.from(t,(a,o)=>{let l=a.trim(),i=s(l);if(typeof i=="number"&&Number.isFinite(i))return i;let r=typeof i=="string"?i:"is not a number";return e.has(o)||e.set(o,`the ${n} ${P(l)?"is missing":`'${l}' ${r}`}`),NaN})}var nt=[",",";","	","|"],st=50,at=20,H=/\r\n|\n|\r/,ot=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function it(e){let n=ot.exec(e)?.[0]??"",t=e.slice(n.length),s=rt(t),a=n.split(H).length,l=[...s===null?lt(t,a):ct(t,s,a)].filter(({cells:u})=>u.some(g=>g.trim()!==""));if(l.length===0)throw new _("the table is empty: there is not even a line with the names of the columns");let{names:i,data:r}=dt(l),c=r.length<l.length,d=i.find((u,g)=>u!==""&&i.indexOf(u)!==g);if(d!==void 0)throw new _(`there are several columns with the name '${d}'`);let h=i.map(()=>[]),p=new Map,m=i.reduce((u,g,w)=>g===""?u:w+1,0);r.forEach(({cells:u},g)=>{let w=u.length>=m&&u.slice(i.length).every(E=>E===""),[O,D]=[`${u.length} field${u.length===1?"":"s"}`,`${i.length} columns`];w||p.set(g,`has ${O}, but there are ${D}`),h.forEach((E,L)=>E.push(u[L]??""))});let b=i.map((u,g)=>[u||`column_${g+1}`,h[g]]).filter(([,u],g)=>i[g]!==""||u.some(w=>w!==""));return{columns:new Map(b),count:r.length,isHeaded:c,lines:r.map(({line:u})=>u),wrong:p}}function rt(e){let n=e.split(H,st).filter(r=>r.trim()!==""),t=n.map(r=>r.replace(/"[^"]*"/g,"")),a=nt.map(r=>({mark:r,widths:t.map(c=>c.split(r).length)})).filter(({widths:r})=>Math.max(0,...r)>1),o=a.filter(({widths:r})=>new Set(r).size===1),l=[...new Set(n.map(r=>r.trim().split(/\s+/).length))];if(a.length===0||o.length===0&&l.length===1&&l[0]>1)return null;let i=({widths:r})=>Math.max(...r.map(c=>c>1?1e6*r.filter(d=>d===c).length+c:0));return(o.length>0?o:a).reduce((r,c)=>i(c)>i(r)?c:r).mark}function*lt(e,n){for(let[t,s]of e.split(H).entries())yield{cells:s.trim().split(/\s+/),line:n+t}}function*ct(e,n,t){let s=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,a=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${s})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),[o,l,i]=[[],t,t];for(;a.lastIndex<e.length;){let r=a.exec(e);if(r===null){let c="a field begins with a quotation mark but does not end with one";throw new _(`line ${l}: ${c}; inside such a field write it twice`)}r[1]!==void 0&&(i+=r[1].split(H).length-1),o.push(r[1]?.replaceAll('""','"')??r[2]??""),r[3]!==n&&(yield{cells:o,line:l},[o,l]=[[],++i])}o.length>0&&(yield{cells:[...o,""],line:l})}function dt(e){let n=e.slice(0,at).map(({cells:c})=>c.map(d=>d.trim())),t=n.map(c=>c.filter(d=>d!=="")),s=c=>N.test(c),a=t.findIndex((c,d)=>B(c)!==null&&(d===0||!c.some(s))),o=t.findIndex(c=>c.length>1),l=Math.max(0,a>=0?a:o);return a<0&&2*t[l].filter(s).length>t[l].length?{names:n[l].length===2?["lon","lat"]:n[l].map((c,d)=>`column_${d+1}`),data:e.slice(l)}:{names:n[l],data:e.slice(l+1)}}function ht(e,{places:n,names:t,values:s}){let a=r=>typeof r=="string"?/[",\r\n]/.test(r)?`"${r.replaceAll('"','""')}"`:r:Object.is(r,-0)?"-0.0":Number.isFinite(r)?String(r):"",o=[...t?[["name",t]]:[],...s??[]],l=[...e,...o.map(([r])=>r)],i=Array.from({length:n.length/2},(r,c)=>[n[2*c],n[2*c+1],...o.map(([,d])=>d[c])]);return[l,...i].map(r=>`${r.map(a).join()}
`).join("")}var _=class extends Error{columns;constructor(e,n=[]){super(e),this.columns=n}};function pt(e){let n=ft(e),t=R(n,"type")==="Feature"?[n]:R(n,"features");if(!Array.isArray(t))throw new _("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=t.map((c,d)=>{let h=gt(c);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=$e(Float64Array.from(a.flat()),s),l=t.map(c=>R(c,"properties")),i=new Set(l.flatMap(c=>Object.keys(c??{}))),r=new Map([...i].map(c=>[c,l.map(d=>ut(R(d,c)))]));return{places:o,table:{columns:r,count:t.length,isHeaded:!0,lines:[],wrong:s}}}function ut(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function R(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function ft(e){try{return JSON.parse(e)}catch(n){throw new _(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}function gt(e){let n=R(e,"geometry"),[t,s]=[R(n,"type"),R(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,l=Array.isArray(o)?o.slice(0,2):[];return l.length===2&&l.every(Number.isFinite)?l:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var pe=1e6;async function mt(e,n,t,s){let{text:a,guess:o}=$t(await yt(n),e),l=/^\s*[{[]/.test(a);if(l&&t==="plane")return{room:"globe"};let i=l?pt(a):wt(a,t,s);if("room"in i)return i;let{places:r,table:c,axes:d=[]}=i,{count:h,wrong:p}=c;if(h===0)throw new _("there are no points");if(h>pe){let g=`the page takes up to ${k(pe)}; for more there is the Python library`;throw new _(`there are ${k(h)} points; ${g}`)}let m=p.size===0?"":bt(c);if(p.size===h)throw new _(m);let $=(g,w)=>!p.has(w),b=new Map([...c.columns].map(([g,w])=>[g,w.filter($)])),u=[...b.keys()].find(g=>g.trim().toLowerCase()==="name")??"";return{file:e,places:r.filter((g,w)=>$(0,w>>1)),names:b.get(u)??null,values:et(b,new Set([...d,u])),leftOut:p.size,wrong:m,guess:o}}function bt({count:e,lines:n,wrong:t}){let s=[...t.keys()].reduce((i,r)=>Math.min(i,r)),a=t.size===e?"No row":`${k(t.size)} of ${k(e)} rows`,o=n.length===0?"":`, on line ${k(n[s])}`,l=t.size===e?"can":"cannot";return`${a} ${l} be placed. Row ${k(s+1)}${o}: ${t.get(s)}`}function wt(e,n,t){let s=it(e),a=[...s.columns.keys()],o=s.isHeaded?B(a,!0):null,l=t??(n==="lonlat"?B(a):Je(a));if(l===null&&o!==null)return{room:"globe"};if(l===null)throw new _("the table has no two columns of coordinates",a);let i=(n==="lonlat"?Ze:Qe)(s,...l),r=[...s.wrong.keys()].filter(c=>Number.isFinite(i[2*c]+i[2*c+1]));return n==="lonlat"&&o===null&&2*r.length>s.count?{room:"lift",columns:l}:{places:i,table:s,axes:l}}async function yt(e){if(!(e[0]===31&&e[1]===139))return e;try{let n=new Blob([e.slice()]).stream().pipeThrough(new DecompressionStream("gzip"));return new Uint8Array(await new Response(n).arrayBuffer())}catch{throw new _("the compressed file is damaged")}}function $t(e,n){let t=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null,a=(c,d)=>{try{let h=new TextDecoder(c,{fatal:!0}).decode(e);return/^\s*</.test(h)||d.test(h)?null:h}catch{return null}},o=a(s??"utf-8",/\0/);if(o!==null)return{text:o,guess:null};let l=s===null?a("windows-1252",Ue):null;if(l!==null)return{text:l,guess:"windows-1252"};let i=/^[\w.-]+$/.test(n)?n:`"${n}"`,r="neither a picture nor a table in text that the page can read";throw new _(`${r}; to make a page of it, type: stereodel web ${i}`)}async function Pe(e,n,t,s,a){if(e.type.startsWith("image/"))return t.pass("globe",e);let{messages:o}=t,l=`${e.name}:`,i=r=>`${r}${/[.?!]$/.test(r)?"":"."} Nothing has changed.`;try{let r=await mt(e.name,new Uint8Array(await e.arrayBuffer()),n,a);if("room"in r)return t.pass(r.room,e,r.columns);let{leftOut:c,wrong:d,guess:h}=r,p=()=>{o.close(),s(r),h!==null&&o.show(l,`it does not say its encoding; read as ${h}.`)};if(c===0)return p();let m=c===1?"this row":`these ${k(c)} rows`;o.show(l,i(d),{words:`Open without ${m}`,act:p})}catch(r){if(!(r instanceof _))throw r;let c=(...d)=>Pe(e,n,t,s,d);r.columns.length>1?_t(e.name,r.columns,n,o,c):o.show(l,i(r.message))}}function _t(e,n,t,s,a){let o=t==="lonlat"?["Longitude","Latitude"]:["x","y"],l=o.map((c,d)=>{let h=y("select","",...n.map(p=>y("option","",p)));return h.selectedIndex=Math.min(d,n.length-1),h}),i={words:"Open",act:()=>a(l[0].value,l[1].value)},r=o.map((c,d)=>y("label","field column",`${c} `,l[d]));s.show(`Which columns of ${e}?`,"",i,r)}var vt=7;function St(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?xt:kt(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var xt={type:"Polygon",coordinates:[[...se(-180,-90,180,90),[-180,-90]]]};function kt(e,n){let t=Et(e.flatMap((i,r)=>ie(i,e[(r+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:Rt(t,s),o=i=>Number(i.toFixed(vt)),l=Pt(a).map(i=>[i.map(([r,c])=>[o(r),o(c)])]);return l.length===1?{type:"Polygon",coordinates:l[0]}:{type:"MultiPolygon",coordinates:l}}function Et(e,n){let t=re(Float64Array.from([...e,e[0]].flatMap(A)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function Rt(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),l=Le(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),i=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),r=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),c=[[-180,l],...i,...r,[180,l]],d=n>0?c:c.reverse();return[...d,[d[d.length-1][0],t],[d[0][0],t],d[0]]}function Le(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function Pt(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let l=e.slice(0,-1).map(([r,c])=>[r-360*o,c]),i=ue(ue(l,-180,1),180,-1);i.length>2&&a.push([...i,i[0]])}return a}function ue(e,n,t){let s=[];return e.forEach((a,o)=>{let l=e[(o+1)%e.length],[i,r]=[t*(a[0]-n)>=0,t*(l[0]-n)>=0];i&&s.push(a),i!==r&&a[0]!==n&&l[0]!==n&&s.push([n,Le(a,l,n)])}),s}var fe=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),ge=2**15,Lt=class{width;height;texels;levels;constructor(e,n){if(this.width=C(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new W(Tt(e));let t=le(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,fe];this.levels=new W(G(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){C(t,"width",1,ge),C(s,"height",1,ge);let o=e.inverse(),l=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),r=[...[this.texels,this.levels,this.width,this.height,fe],l,Float64Array.of(...n),t,s,a?1:0];return G(Uint8ClampedArray,4*t*s,"warp_raster",...r)}};function Tt(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var At=4096,Dt=2,Nt=.25,[Ot,Mt]=[.6,120],It=.01;async function zt(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>It){let i=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${i??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,At)/2),o=y("canvas",{width:2*a,height:a}),l=o.getContext("2d",{willReadFrequently:!0});l.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new Ct(e.name,l.getImageData(0,0,o.width,o.height)))}var Ct=class{name;#t;#e;letters;constructor(e,n){this.name=e,this.#t=new Lt(n.data,n.width),this.#e=Ut(n);let t=[0,0,0];for(let r=0;r<n.data.length;++r)r%4<3&&(t[r%4]+=n.data[r]);let s=t.map(r=>4*r/n.data.length),a=.3*s[0]+.59*s[1]+.11*s[2]>Mt,o=s.map(r=>Math.round(r+Ot*((a?255:0)-r))),[l,i]=a?["27, 27, 27","171, 67, 0"]:["255, 255, 255","245, 160, 98"];this.letters={ink:`rgb(${l})`,accent:`rgb(${i})`,halo:`rgb(${o.join(", ")})`}}draw(e,n,t,s){let a=s&&this.#e===null?Nt:Math.min(Dt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),l=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.within({region:i=>oe(i,n)},()=>e.picture(l,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=y("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},jt=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,Ht=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function Ut(e){let n=y("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,jt],[t.FRAGMENT_SHADER,Ht]]){let l=t.createShader(a);t.shaderSource(l,o),t.compileShader(l),t.attachShader(s,l)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:l},i)=>{n.width!==i&&(n.width=n.height=i),t.viewport(0,0,i,i);for(let[r,{matrix:c}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,r),!0,new Float32Array(c));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/l),t.drawArrays(t.TRIANGLES,0,3),n}):null}var q={ink:"ink",halo:"paper",size:24,align:"center"},me={...q,ink:"ink-2",size:13};async function Te(e,n){let{width:t,paint:s,owner:a}=e;if(!a)return e;let o=be(a.title,1.9*t/q.size),l=o.length*30+(o.length>0?6:0),i=new Image;if(a.legend){let h=a.legend.replace("<svg ",`<svg color="${n}" font-family='${I}' `);i.src=`data:image/svg+xml,${encodeURIComponent(h)}`,await i.decode()}let r=l+e.height+8,c=be(a.source,2.1*t/me.size),d=r+i.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(c.length>0?c.length*17+10:0),paint(h){o.forEach((p,m)=>h.label(p,t/2,26+30*m,q)),h.within({corner:[0,l]},()=>s(h)),a.legend&&h.picture(i,(t-i.width)/2,r,i.width,i.height),c.forEach((p,m)=>h.label(p,t/2,d+14+17*m,me))}}}function be(e,n){let t=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=t[t.length-1];a!==void 0&&a.length+s.length<n?t[t.length-1]=`${a} ${s}`:t.push(s)}return t}var Ft=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import ColorScale, DotStyle, LineStyle, SizeScale, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.interpolation import contours
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
radius = 1.349  # of circles of 150 km, degrees
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[owned] table = {file}  # as the page exports it; the page draws over 1000 lines weaker where dense
[owned] places = table.lonlat
[!owned places] places = {places}
[scaled] values, scale = table.column({valued}), {scale}
[scaled isolines] net = SphericalDelaunay.from_lonlat(places{latitude})
[scaled isolines] levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
[scaled isolines] isolines = [line.lonlat for line in contours(net, values, levels)]
[scaled fills] shades = scale(values)
[owned !scaled] shades = {shades}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude}{title})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[owned fills]     globe.add_cells(SphericalVoronoi.from_lonlat(places{latitude}), colors=shades, style=None)
[owned fills !picture]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule(10, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot(10, radius, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[scaled isolines]     for style in (LineStyle("#fdfcfa", 2.4), LineStyle("#1b1b1b", 0.8)):
[scaled isolines]         globe.add_lines(isolines, style=style, name="isolines")
[owned]     globe.add_points(places, {points})
[places !owned]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, radius)], color=WASH, style=RED)
[named names]     globe.add_labels(places, {words}, size=13.0, movable=True)
    return globe


[!bubble] globe = earth()
[!bubble !owned] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble !owned] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble !owned] page = globe.page(lens, View({view}), width={width})
[!bubble owned] page = globe.page(lens, View({view}), width={width}, legend=True)
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,Wt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,Gt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = projection.forward(points) - shift
flat[(points == pole).all(axis=1)] = 1e9  # a site at the pole is far away
lens = fisheye({lens})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] for corners in opened[np.linalg.det(points[opened]) > 0].tolist():  # others close the hull
[step]     scene.add_region(arcs(zip(corners, corners[1:] + corners[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{step}], name="sites", style=DOT)
scene.add_points(lens(points)[:{step}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,Ae=200,De="cities().lonlat[cities().population >= 2_000_000]",Vt=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${De})`,Bt={cities:De,airports:`airports().lonlat[np.unique(${Vt})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function qt(e,n,t,s,a){let{sites:o,view:l,bubble:i,aim:r,step:c}=e,d=$=>c===null&&e.isOn($),h=[...d("bubble")&&i?.sites||[],...c===null?e.held:[c.site]],p={facets:o.facetCount>0,hemisphere:o.hasClosing,step:c!==null&&c.before.length>0,aimed:i!==null,held:h.length>0,pole:t!==null,front:t!==null&&t[2]>=0,hatched:d("seeing")||d("closing")&&o.hasClosing},m={...a,sites:Bt[s.set]??X(o.lonlat,`${Ne(s.file)}.lonlat`),pole:S(n.pole),view:S(l.middle),aim:A(r).join(", "),lens:`(${S(A(n.lens.focus))}), magnification=${n.lens.magnification}`,held:h.join(", "),step:c===null?"":c.site+1};return Y(Gt,m,p,d)}function Yt(e,n,t,s){let{sites:a,sheet:o,view:l,isOn:i}=e,[r,c]=[e.p,e.q].filter(b=>b!==null),{contact:d,height:h}=n,p=a.count===0?[3,2]:s,m={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:r!==void 0,pair:c!==void 0&&r!==c,pole:n.seenPole!==null},$={points:X(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${S(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:S(l.middle),width:n.width,height:h,scale:n.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[r,c].join(", "),shown:JSON.stringify(n.grounds)};return Y(Wt,$,m,i)}function Xt(e,n,t,s,a){let{lens:o,sight:l,from:i,to:r,before:c,after:d,pointer:h}=e,{places:p,latitude:m,picture:$,resolution:b}=n,u=o==="bubble",{owner:g,names:w,lonlat:O=new Float64Array(0)}=p??{},D=Ne(p?.name??""),E=p===null||m==="spherical"?"":`, latitude="${m}"`,L=U=>{let M=`(${S(A(U))})`;return E===""?M:`lonlat_to_xyz(${M}${E})`},K=({middle:U,roll:M})=>S([...U,M]).replace(/, -?0$/,""),Oe={focus:L(l.lens.focus),magnification:S([l.lens.magnification]),taken:`${L(i.center)}, ${S([i.radius])}`,filled:`${L(r.center)}, ${S([r.radius])}`,title:"",...g?.lines,file:D,places:X(O,`${D}.lonlat`),words:O.length>2*Ae?`${D}.column("name")`:JSON.stringify(w),latitude:E,picture:JSON.stringify($?.name??""),resolution:b,pointer:L(h),before:K(c),view:K(u?d:l.view),width:S([1.03*s*(u?2:1)])},{points:Me,scale:Ie}=g?.lines??{};return Y(Ft,Oe,{bubble:u,picture:$,places:p,pointed:a,owned:Me,scaled:Ie,named:w},t)}function Y(e,n,t,s){let a=c=>c in t?!!t[c]:s(c),l=e.split(`
`).flatMap(c=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(c);return d?.split(" ").every(m=>m.startsWith("!")?!a(m.slice(1)):a(m))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(c,d)=>String(n[d]??c)),i=l.replace(/^(from|import) .*\n/gm,""),r=c=>new RegExp(`\\b${c.split(" as ").pop()}\\b`).test(i);return l.replace(/^((?:from \S+ )?import )(.*)\n/gm,(c,d,h)=>{let p=h.split(", ").filter(r);return p.length===0?"":`${d}${p.join(", ")}
`})}function X(e,n){if(e.length>2*Ae)return`${n}  # the page draws over 1000 lines weaker where dense`;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=t.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return t.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var Ne=e=>`read_points(${JSON.stringify(e)})`;function S(e){return e.map(n=>z(n,7)).join(", ")}async function Kt(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=y("script",{type:"text/plain",id:"block-state"},await Jt(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function Jt(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=new Uint8Array(await new Response(n).arrayBuffer());return btoa(Array.from(t,s=>String.fromCharCode(s)).join(""))}function Zt(e,n){let t=new Blob([n]),s=y("a",{href:URL.createObjectURL(t),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function Qt(e){let{title:n,width:t,height:s,weight:a,paint:o}=await Te(e,T().ink),l=new je(t,s,T(),a);return o(l),l.text(n)}async function en(e,n){let{width:t,height:s,weight:a,paint:o}=await Te(e,T().ink),l=y("canvas",{width:Math.round(t*n),height:Math.round(s*n)}),i=l.getContext("2d");return i.fillStyle=T().paper,i.fillRect(0,0,l.width,l.height),o(new J(i,t,s,n,T(),a)),new Promise((r,c)=>{l.toBlob(d=>d===null?c(new Error("the picture is too large")):r(d))})}var tn={csv:ht,download:Zt,geojson:St,globePython:Xt,liftPython:Yt,openPanorama:zt,openPoints:Pe,savedPage:Kt,sheetPng:en,sheetSvg:Qt,spherePython:qt};Object.assign(document.currentScript,{offers:tn});})();
